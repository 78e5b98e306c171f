#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "burnish/base/parallel.h"
#include "burnish/core/topology.h"
#include "burnish/io/png.h"
#include "burnish/report/histogram.h"
#include "burnish/report/html.h"
#include "burnish/report/mesh_tables.h"
#include "burnish/report/numbers.h"
#include "burnish/report/page_style.h"
#include "burnish/report/picture.h"
#include "burnish/report/report.h"
#include "burnish/report/shade.h"
#include "burnish/report/table.h"

namespace burnish {
namespace {

std::string hex(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

void open_page(HtmlWriter& html, const Record& record) {
  html.verbatim("<!DOCTYPE html>\n");
  html.open("html", {{"lang", "en"}}).open("head");
  html.empty("meta", {{"charset", "utf-8"}});
  html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  // Nothing from outside, whatever a name in a file may try.
  html.empty("meta", {{"http-equiv", "Content-Security-Policy"},
                      {"content",
                       "default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
                       "script-src 'unsafe-inline'"}});
  html.element("title", record.title.empty() ? "burnish report" : record.title);
  html.open("style").verbatim(kPageStyle).close().close().open("body");
}

void write_tile(HtmlWriter& html, std::string_view value, std::string_view what,
                bool wrong = false) {
  html.open("li", {{"class", wrong ? "wrong" : "right"}});
  html.element("b", value).element("span", what).close();
}

/// The first fact whose key speaks of a root mean square.
const Fact* rms_of(const Facts& facts) {
  const auto at = std::find_if(facts.begin(), facts.end(), [](const Fact& fact) {
    return fact.key.find("rms") != std::string::npos;
  });
  return at == facts.end() ? nullptr : &*at;
}

/// The result in a few large numbers.
void write_tiles(HtmlWriter& html, const Record& record) {
  html.open("ul", {{"class", "tiles"}});
  if (!record.phases.empty()) {
    const TriangleMesh& mesh = record.phases.back().mesh;
    const Topology shape = topology(mesh);
    const auto& origins = mesh.triangle_attributes.origin;
    const auto invented = std::count(origins.begin(), origins.end(), Origin::invented);
    std::string on = fmt::format("triangles on {} vertices", count_text(mesh.positions.size()));
    if (invented > 0)
      on += fmt::format("; {} invented", count_text(static_cast<std::size_t>(invented)));
    write_tile(html, count_text(mesh.triangles.size()), on);
    const std::string pieces =
        shape.components == 1 ? "one piece" : count_text(shape.components) + " pieces";
    write_tile(html, shape.closed() ? "closed" : count_text(shape.boundary_loops),
               (shape.closed()              ? "surface, "
                : shape.boundary_loops == 1 ? "boundary loop, "
                                            : "boundary loops, ") +
                   pieces);
    write_tile(html, count_text(shape.non_manifold_edges), "non-manifold edges",
               !shape.edge_manifold());
  }
  if (!record.comparisons.empty()) {
    const Fact* last = rms_of(record.comparisons.back().second);
    const Fact* first = rms_of(record.comparisons.front().second);
    if (last) {
      std::string what = "RMS distance to the true surface";
      if (first && first != last) {
        what += fmt::format("; {} {}", record.comparisons.front().first,
                            quantity_text(first->value, first->unit));
      }
      write_tile(html, quantity_text(last->value, last->unit), what);
    }
  }
  const double seconds = std::accumulate(record.steps.begin(), record.steps.end(), 0.0,
                                         [](double sum, const Step& s) { return sum + s.seconds; });
  if (!record.steps.empty()) {
    write_tile(
        html, quantity_text(seconds, "s"),
        fmt::format("in {} step{}", record.steps.size(), record.steps.size() == 1 ? "" : "s"));
  }
  html.close();
}

void write_head(HtmlWriter& html, const Record& record) {
  html.open("header");
  html.element("p", "burnish report", {{"class", "kind"}});
  html.element("h1", record.title.empty() ? "Report" : record.title);
  if (!record.command.empty()) html.element("code", record.command, {{"class", "code"}});
  write_tiles(html, record);
  html.close();
}

void write_swatch(HtmlWriter& html, const Color& color, std::string_view what) {
  html.open("span", {{"class", "item"}});
  html.open("span", {{"class", "swatch"}, {"style", "background:" + hex(color)}}).close();
  html.text(what).close();
}

void write_color_legend(HtmlWriter& html, const Record& record) {
  const PictureOptions colors;
  bool interpolated = false, invented = false;
  for (const Phase& phase : record.phases) {
    for (const std::vector<Origin>* origins :
         {&phase.mesh.attributes.origin, &phase.mesh.triangle_attributes.origin}) {
      for (const Origin origin : *origins) {
        interpolated = interpolated || origin == Origin::interpolated;
        invented = invented || origin == Origin::invented;
      }
    }
  }
  html.open("p", {{"class", "legend"}});
  write_swatch(html, colors.surface, "outer side");
  write_swatch(html, colors.back, "inner side, or flipped");
  if (interpolated) write_swatch(html, colors.interpolated, "interpolated");
  if (invented) write_swatch(html, colors.invented, "invented, where nothing was seen");
  html.close();
}

/// The colours from low to high with the numbers at both ends.
void write_scale(HtmlWriter& html, const ColorScale& scale) {
  html.open("div", {{"class", "scale"}});
  html.element("span", scale.title + ": " + limit_text(scale, scale.low));
  constexpr int kSteps = 64;
  html.open("svg", {{"viewBox", fmt::format("0 0 {} 1", kSteps)},
                    {"preserveAspectRatio", "none"},
                    {"aria-hidden", "true"}});
  for (int i = 0; i < kSteps; ++i) {
    // A little wider than a step, so that no seams show.
    html.open("rect", {{"x", std::to_string(i)},
                       {"width", "1.1"},
                       {"height", "1"},
                       {"fill", hex(color_of((i + 0.5) / kSteps))}})
        .close();
  }
  html.close().element("span", limit_text(scale, scale.high) + " and more").close();
}

/// The pictures of all plates as PNG files, plate after plate.
Result<std::vector<std::string>> encoded_pictures(const Plates& plates, const Context& context) {
  std::vector<const Image*> images;
  for (const Plate& plate : plates.plates) {
    for (const Image& image : plate.pictures) images.push_back(&image);
  }
  std::vector<std::string> files(images.size());
  std::vector<Result<void>> outcomes(images.size());
  const auto encode = [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Image& image = *images[i];
      if (image.pixels.empty()) continue;
      auto png = encode_png(image.width, image.height, image.pixels);
      if (png) {
        files[i] = std::move(*png);
      } else {
        outcomes[i] = png.error();
      }
    }
  };
  if (!parallel_for(context, images.size(), encode, 1)) return cancelled();
  for (const Result<void>& outcome : outcomes) {
    if (!outcome) return outcome.error();
  }
  return files;
}

/// `files`: the plate's pictures as PNG files, empty where there is none.
void write_plate(HtmlWriter& html, const Record& record, const Plates& plates, const Plate& plate,
                 std::span<const std::string> files) {
  html.open("section", {{"class", "plate"}, {"data-name", plate.name}});
  html.open("h3").text(words_of(plate.name) + " ").element("span", plate.caption).close();
  if (plate.scale) write_scale(html, *plate.scale);
  html.open("div", {{"class", "row"}});
  for (std::size_t i = 0; i < plate.pictures.size(); ++i) {
    const Image& image = plate.pictures[i];
    if (files[i].empty()) continue;
    const std::string& phase = record.phases[plates.phases[i]].name;
    const std::string what = phase + ", " + plate.name;
    html.open("figure");
    html.empty("img", {{"src", "data:image/png;base64," + base64(files[i])},
                       {"alt", plate.caption.empty() ? what : what + ", " + plate.caption},
                       {"data-phase", phase},
                       {"width", std::to_string(image.width)},
                       {"height", std::to_string(image.height)}});
    html.element("figcaption", phase).close();
  }
  html.close().close();
}

Result<void> write_plates(HtmlWriter& html, const Record& record, const Plates& plates,
                          const Context& context) {
  if (plates.plates.empty()) return {};
  const auto files = encoded_pictures(plates, context);
  if (!files) return files.error();
  html.open("section").element("h2", "Pictures");
  write_color_legend(html, record);
  std::span<const std::string> left(*files);
  for (const Plate& plate : plates.plates) {
    write_plate(html, record, plates, plate, left.first(plate.pictures.size()));
    left = left.subspan(plate.pictures.size());
  }
  html.close();
  return {};
}

/// A parameter with its unit: lengths as people read them, the rest as typed.
std::string setting_text(const Step& step, const std::string& key, const std::string& value) {
  for (const FieldInfo& field : step.fields) {
    if (field.key != key || field.unit.empty()) continue;
    const Quantity quantity = field.unit == "m"     ? Quantity::length
                              : field.unit == "rad" ? Quantity::angle
                                                    : Quantity::time;
    if (const auto number = parse_quantity(value, quantity)) {
      return quantity_text(*number, field.unit);
    }
  }
  return value;
}

void write_pair(HtmlWriter& html, std::string_view key, std::string_view value) {
  html.open("li").element("span", key).text(" ").element("b", value).close();
}

void write_steps(HtmlWriter& html, const Record& record) {
  if (record.steps.empty()) return;
  html.open("section").element("h2", "What was done");
  html.open("div", {{"class", "scroll"}}).open("table", {{"class", "steps"}});
  html.element("caption", "Steps in their order, with every parameter as it was used");
  html.open("thead").open("tr");
  for (const char* column : {"Step", "Parameters", "Result", "Time"}) {
    html.element("th", column, {{"scope", "col"}});
  }
  html.close().close().open("tbody");
  for (const Step& step : record.steps) {
    html.open("tr").open("th", {{"scope", "row"}}).text(words_of(step.verb) + " ");
    html.element("span", step.method, {{"class", "method"}}).close();
    html.open("td").open("ul", {{"class", "pairs"}});
    for (const auto& [key, value] : step.settings) {
      write_pair(html, key, setting_text(step, key, value));
    }
    html.close().close().open("td").open("ul", {{"class", "pairs"}});
    for (const Fact& fact : step.facts) {
      write_pair(html, words_of(fact.key), quantity_text(fact.value, fact.unit));
    }
    html.close().close();
    html.element("td", quantity_text(step.seconds, "s"), {{"class", "number"}}).close();
  }
  html.close().close().close().close();
}

/// From 0 to a round number that 99.5 % of the edges of every phase do not exceed.
Axis edge_axis(const std::vector<TriangleShapes>& shapes) {
  double longest = 0;
  for (const TriangleShapes& shape : shapes) {
    if (shape.edges.empty()) continue;
    std::vector<float> edges = shape.edges;
    const auto at = edges.begin() + static_cast<std::ptrdiff_t>((edges.size() - 1) * 995 / 1000);
    std::nth_element(edges.begin(), at, edges.end());
    longest = std::max(longest, static_cast<double>(*at));
  }
  const DisplayUnit unit = display_unit("m", longest);
  Axis axis{"Lengths of the edges", std::string(unit.name), unit.factor};
  const double step = nice_step(longest * unit.factor, 12);
  axis.high = longest > 0 ? step * std::ceil(longest * unit.factor / step * (1 - 1e-9)) : 1;
  return axis;
}

Result<void> write_triangles(HtmlWriter& html, const Record& record, const Context& context) {
  if (record.phases.empty()) return {};
  const auto quality = quality_table(record, context);
  if (!quality) return quality.error();
  std::vector<TriangleShapes> shapes;
  for (const Phase& phase : record.phases) shapes.push_back(triangle_shapes(phase.mesh));
  std::vector<Series> angles, edges;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    angles.push_back({record.phases[i].name, shapes[i].angles});
    edges.push_back({record.phases[i].name, shapes[i].edges});
  }
  Axis degrees{"Angles of the triangles", "degrees"};
  degrees.high = 180, degrees.mark = 60, degrees.mark_label = "equilateral";
  html.open("section").element("h2", "Triangles").open("div", {{"class", "charts"}});
  write_histogram(html, "angles", degrees, angles);
  write_histogram(html, "edges", edge_axis(shapes), edges);
  html.close();
  write_table(html, *quality);
  html.close();
  return {};
}

void write_surface(HtmlWriter& html, const Record& record) {
  if (record.phases.empty()) return;
  html.open("section").element("h2", "Surface");
  write_table(html, topology_table(record));
  if (const Table trust = trust_table(record); !trust.rows.empty()) write_table(html, trust);
  html.close();
}

void write_comparisons(HtmlWriter& html, const Record& record) {
  if (record.comparisons.empty()) return;
  Table table{"Distance to the true surface", {}, {}};
  std::vector<Facts> facts;
  for (const auto& [name, found] : record.comparisons) {
    table.columns.push_back(name);
    facts.push_back(found);
  }
  table.rows = rows_of(facts);
  html.open("section").element("h2", "Against the truth");
  write_table(html, table);
  html.close();
}

void write_list(HtmlWriter& html, std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  html.open("section").element("h2", title).open("ul", {{"class", "plain"}});
  for (const std::string& line : lines) html.element("li", line);
  html.close().close();
}

/// What is certified of the smoothing, and what is not.
void write_certificate(HtmlWriter& html, const Record& record) {
  if (record.certificate) write_list(html, "Noise bound", sentences(*record.certificate));
}

void write_foot(HtmlWriter& html, const Record& record) {
  write_list(html, "Notes", record.notes);
  write_list(html, "Inputs", record.inputs);
  if (!record.versions.empty()) {
    html.open("section").element("h2", "Versions").open("ul", {{"class", "pairs"}});
    for (const auto& [name, version] : record.versions) write_pair(html, name, version);
    html.close().close();
  }
  html.element(
      "footer",
      "Pictures are cast ray by ray, with one normal per triangle and the same light in all "
      "of them.");
}

}  // namespace

Result<std::string> html_report(const Record& record, const Plates& plates,
                                const Context& context) {
  HtmlWriter html;
  open_page(html, record);
  write_head(html, record);
  html.open("main");
  if (auto done = write_plates(html, record, plates, context.part(0, 0.7)); !done) {
    return done.error();
  }
  write_steps(html, record);
  write_certificate(html, record);
  write_comparisons(html, record);
  if (auto done = write_triangles(html, record, context.part(0.7, 0.9)); !done) {
    return done.error();
  }
  if (context.cancelled()) return cancelled();
  write_surface(html, record);
  html.close();
  write_foot(html, record);
  html.open("script").verbatim(kPageScript).close();
  context.progress(1);
  return html.finish();
}

}  // namespace burnish
