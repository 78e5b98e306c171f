#include "burnish/report/report.h"

#include "burnish/io/atomic_writer.h"
#include "burnish/io/png.h"

namespace burnish {
namespace {

/// A name as part of a file name: small letters, digits and dashes.
std::string file_word(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const bool capital = c >= 'A' && c <= 'Z';
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (plain || capital) {
      word += capital ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!word.empty() && word.back() != '-') {
      word += '-';
    }
  }
  while (word.ends_with('-')) word.pop_back();
  return word.empty() ? "unnamed" : word;
}

Result<void> write_png(const std::filesystem::path& path, const Image& image) {
  const auto bytes = encode_png(image.width, image.height, image.pixels);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

}  // namespace

Result<void> write_report(const std::filesystem::path& path, const Record& record,
                          const Plates& plates, const Context& context) {
  const auto page = html_report(record, plates, context.part(0, 0.95));
  if (!page) return page.error();
  if (context.cancelled()) return cancelled();
  if (auto written = write_file(path, *page); !written) return written.error();
  context.progress(1);
  return {};
}

Result<void> write_report(const std::filesystem::path& path, const Record& record,
                          const ReportOptions& options, const Context& context) {
  const auto plates = paint_plates(record, options, context.part(0, 0.8));
  if (!plates) return plates.error();
  return write_report(path, record, *plates, context.part(0.8, 1));
}

Result<std::vector<std::filesystem::path>> write_pictures(const std::filesystem::path& prefix,
                                                          const Record& record,
                                                          const Plates& plates,
                                                          const Context& context) {
  std::vector<std::filesystem::path> paths;
  if (plates.plates.empty()) return paths;
  const auto write = [&](const std::string& name, const Image& image) -> Result<void> {
    if (context.cancelled()) return cancelled();
    const std::filesystem::path path = prefix.string() + "-" + name + ".png";
    if (auto written = write_png(path, image); !written) return written.error();
    paths.push_back(path);
    return {};
  };
  if (auto done = write("overview", contact_sheet(record, plates)); !done) return done.error();
  for (std::size_t i = 0; i < plates.plates.size(); ++i) {
    const Plate& plate = plates.plates[i];
    for (std::size_t k = 0; k < plate.pictures.size(); ++k) {
      if (plate.pictures[k].pixels.empty()) continue;
      const std::string phase = file_word(record.phases[plates.phases[k]].name);
      if (auto done = write(file_word(plate.name) + "-" + phase, plate.pictures[k]); !done) {
        return done.error();
      }
    }
    context.progress(static_cast<double>(i + 1) / static_cast<double>(plates.plates.size()));
  }
  return paths;
}

}  // namespace burnish
