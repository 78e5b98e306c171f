#include "summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "burnish/core/topology.h"

namespace burnish::app {

void say_steps(const Session& session, const Record& record) {
  for (const Step& step : record.steps) {
    std::string line = fmt::format("{} {}:", step.verb, step.method);
    const char* separator = " ";
    for (const Fact& fact : step.facts) {
      line += fmt::format("{}{} {}", separator, fact.key, readable(fact));
      separator = ", ";
    }
    say(session, fmt::format("{} ({:.2f} s)", line, step.seconds));
  }
  for (const std::string& note : record.notes) say(session, "note: " + note);
}

void say_methods(const Session& session, const Record& record) {
  for (const Step& step : record.steps) {
    say(session, fmt::format("{} {}", step.verb, to_string(Method{step.method, step.settings})));
  }
}

void say_comparisons(const Session& session, const Record& record) {
  const auto value = [](const Facts& facts, std::string_view key) {
    const auto found =
        std::find_if(facts.begin(), facts.end(), [&](const Fact& f) { return f.key == key; });
    return found == facts.end() ? Fact{} : *found;
  };
  double raw = 0;
  for (const auto& [name, facts] : record.comparisons) {
    // Raw points are compared with the vertices that came of them, not with all of the surface.
    const bool points = !value(facts, "rms").key.empty();
    const std::string prefix = points ? "" : "vertices_";
    const Fact rms = value(facts, prefix + "rms");
    if (points) raw = rms.value;
    std::string line =
        fmt::format("{} against the truth: rms {}, mean {}, 95 % within {}, max {}", name,
                    readable(rms), readable(value(facts, prefix + "mean")),
                    readable(value(facts, prefix + "p95")), readable(value(facts, prefix + "max")));
    if (!points && raw > 0)
      line += fmt::format("; rms is {:.2f} of the raw points'", rms.value / raw);
    say(session, line);
  }
}

void say_mesh(const Session& session, const std::string& name, const TriangleMesh& mesh) {
  const Topology t = topology(mesh);
  say(session, fmt::format("{}: {} vertices, {} triangles, {} components, {} boundary loops, "
                           "{} non-manifold edges, {}",
                           name, mesh.positions.size(), mesh.triangles.size(), t.components,
                           t.boundary_loops, t.non_manifold_edges,
                           t.oriented() ? "one orientation" : "orientation disagrees"));
}

void keep_notes(const std::string& path, const GeometryFile& file, Record& record) {
  for (const std::string& note : file.notes)
    record.notes.push_back(fmt::format("{}: {}", path, note));
}

void say_certificate(const Session& session, const Record& record) {
  for (const std::string& line : comments_of(record)) say(session, line);
}

std::vector<std::string> comments_of(const Record& record) {
  if (!record.certificate) return {};
  std::vector<std::string> lines = sentences(*record.certificate);
  for (std::string& line : lines) line = "noise bound: " + line;
  return lines;
}

Result<void> save(const std::string& path, const TriangleMesh& mesh, const Session& session,
                  const Context& context, std::vector<std::string> comments) {
  context.stage("writing " + path);
  return finish_writing(write_mesh(path, mesh, {.comments = std::move(comments)}, context), path,
                        session);
}

Result<void> save(const std::string& path, const PointCloud& cloud, const Session& session,
                  const Context& context) {
  context.stage("writing " + path);
  return finish_writing(write_cloud(path, cloud, {}, context), path, session);
}

Result<void> finish_writing(const Result<WriteReport>& written, const std::string& path,
                            const Session& session) {
  if (!written) return written.error();
  for (const std::string& note : written->notes) say(session, fmt::format("{}: {}", path, note));
  return {};
}

}  // namespace burnish::app
