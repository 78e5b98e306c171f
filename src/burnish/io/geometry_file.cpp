#include "burnish/io/geometry_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "burnish/io/file.h"
#include "burnish/io/file_format.h"
#include "burnish/io/obj.h"
#include "burnish/io/off.h"
#include "burnish/io/output.h"
#include "burnish/io/pcd.h"
#include "burnish/io/ply.h"
#include "burnish/io/stl.h"
#include "burnish/io/xyz.h"

namespace burnish {
namespace fs = std::filesystem;

namespace {

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return extension;
}

const FileFormat* format_with_extension(const std::string& extension) {
  for (const FileFormat& format : geometry_formats()) {
    const auto& all = format.extensions;
    if (std::find(all.begin(), all.end(), extension) != all.end()) return &format;
  }
  return nullptr;
}

std::string all_extensions(bool writable) {
  std::string text;
  for (const FileFormat& format : geometry_formats()) {
    if (writable && !format.write) continue;
    for (const std::string_view extension : format.extensions)
      text += fmt::format("{}{}", text.empty() ? "" : " ", extension);
  }
  return text;
}

/// The content decides; lines of plain numbers only where the extension names no other format.
const FileFormat* format_of(std::string_view bytes, const FileFormat* by_extension) {
  for (const FileFormat& format : geometry_formats()) {
    if (format.recognises(bytes) && !(format.name == "xyz" && by_extension)) return &format;
  }
  return by_extension;
}

/// Passes on only what rises: readers may go through a file more than once.
class RisingProgress : public ProgressSink {
 public:
  explicit RisingProgress(const Context& context) : context_(context) {}
  void on_progress(double fraction) override {
    if (fraction <= highest_) return;
    highest_ = fraction;
    context_.progress(fraction);
  }

 private:
  const Context& context_;
  double highest_ = 0;
};

Result<GeometryFile> parse(const fs::path& path, std::string_view bytes, const Context& context) {
  const std::string name = path.string();
  if (bytes.empty()) return Error{ErrorCode::bad_file, "the file is empty", name};
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    return Error{ErrorCode::unsupported, "the file is UTF-16 text, which is not supported", name};
  }
  const FileFormat* by_extension = format_with_extension(extension_of(path));
  const FileFormat* format = format_of(bytes, by_extension);
  if (!format) {
    return Error{
        ErrorCode::unsupported,
        "neither content nor extension is of a known format (" + all_extensions(false) + ")", name};
  }
  RisingProgress progress(context);
  Context inner;
  inner.stop = context.stop;
  inner.sink = &progress;
  auto file = format->read(bytes, name, inner);
  if (file) inner.progress(1);
  if (file && by_extension && by_extension != format) {
    file->notes.push_back(
        fmt::format("the content is {}, whatever the extension says", format->name));
  }
  return file;
}

/// What `format` cannot hold of `view`, a sentence each; an error where that is geometry.
Result<std::vector<std::string>> losses(const FileFormat& format, const GeometryView& view,
                                        const WriteOptions& options) {
  const auto refuse = [&](std::string_view what) {
    return Error{ErrorCode::unsupported, fmt::format("{} cannot hold {}", format.title, what), {}};
  };
  const Holds& holds = format.holds;
  const Attributes& attributes = view.attributes;
  if (!view.triangles.empty() && !holds.triangles)
    return refuse("triangles; write PLY, OBJ, OFF or STL");
  if (view.triangles.empty() && !view.positions.empty() && !holds.points) {
    return refuse("points without triangles; write PLY, PCD, OBJ or OFF");
  }
  std::vector<std::string> notes;
  const auto lose = [&](bool present, bool held, std::string_view what) {
    if (present && !held)
      notes.push_back(fmt::format("{} cannot hold {}: left out", format.title, what));
  };
  const auto& colors = attributes.colors;
  lose(!attributes.normals.empty(), holds.normals, "normals");
  lose(!colors.empty(), holds.colors, "colours");
  lose(std::any_of(colors.begin(), colors.end(), [](const Color& c) { return c[3] != 255; }),
       holds.alpha || !holds.colors, "alpha");
  lose(!attributes.sigma.empty(), holds.measures, "sigma");
  lose(!attributes.noise.empty(), holds.measures, "noise");
  lose(!attributes.observations.empty(), holds.measures, "observations");
  lose(!attributes.origin.empty(), holds.measures, "origin");
  for (const Channel& channel : attributes.channels) {
    lose(channel.size() > 0, holds.channels, fmt::format("the channel '{}'", channel.name));
  }
  lose(view.framed(), holds.doubles || (options.ascii && format.has_ascii),
       "coordinates beyond float precision");
  lose(view.viewpoint.has_value(), holds.viewpoint, "the viewpoint");
  lose(!view.triangle_origin.empty(), holds.triangle_attributes, "the origin of triangles");
  lose(!view.triangle_owner.empty(), holds.triangle_attributes, "the owner of triangles");
  if (!holds.points) {
    std::vector<bool> used(view.positions.size());
    for (const Triangle& triangle : view.triangles) {
      for (const std::uint32_t v : triangle) used[v] = true;
    }
    lose(std::find(used.begin(), used.end(), false) != used.end(), false,
         "vertices that no triangle uses");
  }
  return notes;
}

Result<WriteReport> write_format(const fs::path& path, const FileFormat& format,
                                 const GeometryView& view, const WriteOptions& options,
                                 const Context& context) {
  const auto here = [&](Error error) {
    if (error.where.empty() && error.code != ErrorCode::cancelled) error.where = path.string();
    return error;
  };
  auto notes = losses(format, view, options);
  if (!notes) return here(notes.error());
  if (context.cancelled()) return cancelled();
  auto writer = AtomicWriter::create(path);
  if (!writer) return writer.error();
  const std::size_t rows =
      (format.holds.points ? view.positions.size() : 0) + view.triangles.size();
  Output out(*writer, rows, context);
  format.write(out, view, options);
  if (auto ok = out.finish(); !ok) return here(ok.error());
  if (auto ok = writer->commit(); !ok) return ok.error();
  context.progress(1);
  return WriteReport{std::move(*notes)};
}

Error located(Error error, const fs::path& path) {
  if (error.where.empty()) error.where = "to be written to " + path.string();
  return error;
}

}  // namespace

Result<const FileFormat*> format_to_write(const fs::path& path) {
  const FileFormat* format = format_with_extension(extension_of(path));
  if (format && format->write) return format;
  return Error{ErrorCode::unsupported,
               "the extension names no format that can be written (" + all_extensions(true) + ")",
               path.string()};
}

std::span<const FileFormat> geometry_formats() {
  static const std::vector<FileFormat> formats{
      {"ply",
       "PLY",
       {".ply"},
       {.triangles = true,
        .points = true,
        .normals = true,
        .colors = true,
        .alpha = true,
        .measures = true,
        .channels = true,
        .doubles = true,
        .grid = true,
        .viewpoint = true,
        .triangle_attributes = true},
       true,
       true,
       recognise_ply,
       read_ply,
       write_ply},
      {"pcd",
       "PCD",
       {".pcd"},
       {.points = true,
        .normals = true,
        .colors = true,
        .alpha = true,
        .measures = true,
        .channels = true,
        .doubles = true,
        .grid = true,
        .viewpoint = true},
       true,
       true,
       recognise_pcd,
       read_pcd,
       write_pcd},
      {"off",
       "OFF",
       {".off", ".coff", ".noff", ".cnoff"},
       {.triangles = true,
        .points = true,
        .normals = true,
        .colors = true,
        .alpha = true,
        .doubles = true},
       true,
       false,
       recognise_off,
       read_off,
       write_off},
      {"stl", "STL", {".stl"}, {.triangles = true}, true, true, recognise_stl, read_stl, write_stl},
      {"obj",
       "OBJ",
       {".obj"},
       {.triangles = true, .points = true, .normals = true, .colors = true, .doubles = true},
       true,
       false,
       recognise_obj,
       read_obj,
       write_obj},
      {"xyz",
       "XYZ",
       {".xyz", ".xyzn", ".xyzrgb", ".txt", ".asc", ".csv", ".pts"},
       {.points = true, .normals = true, .colors = true, .channels = true, .doubles = true},
       false,
       false,
       recognise_xyz,
       read_xyz,
       nullptr},
  };
  return formats;
}

Result<GeometryFile> read_geometry(const fs::path& path, const Context& context) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  try {
    return parse(path, bytes->text(), context);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "the file does not fit into memory", path.string()};
  }
}

Result<TriangleMesh> mesh_of(GeometryFile file, const fs::path& path) {
  if (!file.mesh.triangles.empty()) return std::move(file.mesh);
  return Error{ErrorCode::bad_geometry,
               fmt::format("a mesh was expected, the file has {} points and no triangles",
                           file.mesh.positions.size()),
               path.string()};
}

Result<TriangleMesh> read_mesh(const fs::path& path, const Context& context) {
  auto file = read_geometry(path, context);
  if (!file) return file.error();
  return mesh_of(*std::move(file), path);
}

PointCloud cloud_of(GeometryFile file) {
  return {std::move(file.mesh.positions), std::move(file.mesh.attributes), file.grid,
          file.viewpoint, file.mesh.frame};
}

Result<PointCloud> read_cloud(const fs::path& path, const Context& context) {
  auto file = read_geometry(path, context);
  if (!file) return file.error();
  return cloud_of(*std::move(file));
}

Result<WriteReport> write_mesh(const fs::path& path, const TriangleMesh& mesh,
                               const WriteOptions& options, const Context& context) {
  const auto format = format_to_write(path);
  if (!format) return format.error();
  if (auto sound = check(mesh); !sound) return located(sound.error(), path);
  const GeometryView view{mesh.positions,
                          mesh.triangles,
                          mesh.attributes,
                          mesh.frame,
                          std::nullopt,
                          std::nullopt,
                          mesh.triangle_attributes.origin,
                          mesh.triangle_attributes.owner};
  return write_format(path, **format, view, options, context);
}

Result<WriteReport> write_cloud(const fs::path& path, const PointCloud& cloud,
                                const WriteOptions& options, const Context& context) {
  const auto format = format_to_write(path);
  if (!format) return format.error();
  if (auto sound = check(cloud); !sound) return located(sound.error(), path);
  if (cloud.grid && !(*format)->holds.grid) {
    const PointCloud present = without_missing(cloud);
    auto report = write_cloud(path, present, options, context);
    if (report) {
      report->notes.push_back(
          fmt::format("{} cannot hold the grid of an organized cloud: {} missing pixels left out",
                      (*format)->title, cloud.positions.size() - present.positions.size()));
    }
    return report;
  }
  const GeometryView view{cloud.positions, {},         cloud.attributes,
                          cloud.frame,     cloud.grid, cloud.viewpoint};
  return write_format(path, **format, view, options, context);
}

}  // namespace burnish
