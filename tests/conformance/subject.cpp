#include "conformance/subject.h"

#include <cstdlib>
#include <numeric>

#include "conformance/exceptions.h"
#include "conformance/samples.h"

namespace burnish::test {
namespace {

Subject subject_of(const AverageOperation& operation) {
  return {"average",
          operation.info,
          {{}, {}, sample_frames()},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto created = operation.run(input.frames, settings, context);
            if (!created) return created.error();
            return Outcome{{{}, {}, {created->value}}, created->facts};
          },
          operation.resolve};
}

Subject subject_of(const FilterOperation& operation) {
  return {"filter",
          operation.info,
          {{}, {}, {sample_frames().front()}},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto facts = operation.run(input.frames.front(), settings, context);
            if (!facts) return facts.error();
            return Outcome{input, *facts};
          },
          operation.resolve};
}

/// The first rows of an organized cloud, for operations that take their time.
PointCloud quarter_of(PointCloud cloud) {
  cloud.grid->height /= 4;
  std::vector<std::uint32_t> kept(std::size_t{cloud.grid->width} * cloud.grid->height);
  std::iota(kept.begin(), kept.end(), 0u);
  cloud.positions.resize(kept.size());
  cloud.attributes = gather(cloud.attributes, kept);
  return cloud;
}

/// Cleaning and thinning alike: an edit of a cloud.
Subject subject_of(std::string family, const CleanOperation& operation, const PointCloud& sample) {
  return {std::move(family),
          operation.info,
          {{sample}, {}},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto facts = operation.run(input.clouds.front(), settings, context);
            if (!facts) return facts.error();
            return Outcome{input, *facts};
          },
          operation.resolve};
}

Subject subject_of(const MergeOperation& operation) {
  return {"merge",
          operation.info,
          {sample_clouds(), {}},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto created = operation.run(input.clouds, settings, context);
            if (!created) return created.error();
            return Outcome{{{created->value}, {}}, created->facts};
          },
          operation.resolve};
}

Subject subject_of(const FuseOperation& operation) {
  return {"fuse",
          operation.info,
          {{}, {}, sample_frames()},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto created = operation.run(FramesInMemory(input.frames), settings, context);
            if (!created) return created.error();
            return Outcome{{{}, created->value}, created->facts};
          },
          operation.resolve};
}

Subject subject_of(const TriangulateOperation& operation) {
  return {"triangulate",
          operation.info,
          {{sample_clouds().front()}, {}},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto created = operation.run(input.clouds.front(), settings, context);
            if (!created) return created.error();
            return Outcome{{{}, created->value}, created->facts};
          },
          operation.resolve};
}

/// Repair, smoothing, simplification and refinement alike: an edit of a mesh.
Subject subject_of(std::string family, const SmoothOperation& operation) {
  return {std::move(family),
          operation.info,
          {{}, sample_mesh()},
          [&operation](Workpiece& input, const Settings& settings,
                       const Context& context) -> Result<Outcome> {
            auto facts = operation.run(input.mesh, settings, context);
            if (!facts) return facts.error();
            return Outcome{input, *facts};
          },
          operation.resolve};
}

std::vector<std::string> other_texts(const FieldInfo& field) {
  std::vector<std::string> texts;
  if (field.type == "choice" || field.type == "flag") {
    std::string_view rest = field.range;
    while (!rest.empty()) {
      const std::size_t bar = rest.find(" | ");
      texts.emplace_back(rest.substr(0, bar));
      rest = bar == std::string_view::npos ? std::string_view{} : rest.substr(bar + 3);
    }
    return texts;
  }
  const Quantity quantity = field.type == "angle" ? Quantity::angle : Quantity::number;
  const double value = parse_quantity(field.default_value, quantity).value();
  if (field.type == "integer") {
    for (const double other : {value + 1, value * 2, value - 1, value + 10, 0.0, 1.0}) {
      texts.push_back(std::to_string(static_cast<long>(other)));
    }
    return texts;
  }
  for (const double other :
       {value * 1.5, value / 1.5, value * 4, value / 4, 0.5, 0.01, 0.05, 0.0, 1.0}) {
    texts.push_back(quantity_text(other, quantity));
  }
  return texts;
}

}  // namespace

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> result;
    for (const auto& operation : average_operations()) result.push_back(subject_of(operation));
    for (const auto& operation : filter_operations()) result.push_back(subject_of(operation));
    for (const auto& operation : clean_operations())
      result.push_back(subject_of("clean", operation, sample_clouds().front()));
    for (const auto& operation : merge_operations()) result.push_back(subject_of(operation));
    for (const auto& operation : fuse_operations()) result.push_back(subject_of(operation));
    for (const auto& operation : thin_operations()) {
      result.push_back(subject_of("thin", operation, quarter_of(sample_clouds().front())));
    }
    for (const auto& operation : triangulate_operations()) result.push_back(subject_of(operation));
    for (const auto& operation : repair_operations())
      result.push_back(subject_of("repair", operation));
    for (const auto& operation : smooth_operations())
      result.push_back(subject_of("smooth", operation));
    for (const auto& operation : simplify_operations())
      result.push_back(subject_of("simplify", operation));
    for (const auto& operation : refine_operations())
      result.push_back(subject_of("refine", operation));
    return result;
  }();
  return all;
}

std::vector<SubjectRef> subject_refs() {
  std::vector<SubjectRef> refs;
  for (const Subject& subject : subjects()) refs.push_back({&subject});
  return refs;
}

std::vector<Settings> variations(const Subject& subject, const FieldInfo& field) {
  std::vector<Settings> result;
  for (std::string& text : other_texts(field)) {
    Settings settings = companion(subject.name(), field.key).settings;
    settings.emplace_back(field.key, std::move(text));
    const bool is_default = settings.back().second == field.default_value;
    if (!is_default && subject.resolve(settings)) result.push_back(std::move(settings));
  }
  return result;
}

}  // namespace burnish::test
