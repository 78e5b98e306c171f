#include "burnish/sensor/frame_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>

#include "burnish/io/cursor.h"
#include "burnish/io/file.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes the run of digits off the front of `text`, without its leading zeros.
std::string_view take_digits(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && is_digit(text[length])) ++length;
  std::string_view digits = text.substr(0, length);
  text.remove_prefix(length);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

/// The images of a folder in natural order; those with "depth" in their names, where there are any.
Result<std::vector<fs::path>> images_in(const fs::path& folder) {
  std::vector<fs::path> images;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code ignored;
    const bool hidden = entry->path().filename().string().starts_with('.');
    if (!hidden && is_depth_image(entry->path()) && entry->is_regular_file(ignored)) {
      images.push_back(entry->path());
    }
  }
  if (failed) return Error{ErrorCode::io_failure, failed.message(), folder.string()};
  const auto says_depth = [](const fs::path& path) {
    return path.filename().string().find("depth") != std::string::npos;
  };
  if (std::any_of(images.begin(), images.end(), says_depth))
    std::erase_if(images, std::not_fn(says_depth));
  std::sort(images.begin(), images.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return images;
}

/// The images that a depth.txt of TUM RGB-D lists.
Result<FrameLayout> read_tum_list(const fs::path& list) {
  auto images = read_image_list(list);
  if (!images) return images.error();
  FrameLayout layout;
  layout.images = std::move(images->images);
  layout.times = std::move(images->times);
  layout.folders = {list.parent_path()};
  layout.whole_folder = layout.tum = true;
  return layout;
}

/// Timestamps that the names themselves are ("1305031102.160407.png"); empty unless all are.
std::vector<double> times_from_names(const std::vector<fs::path>& images) {
  std::vector<double> times;
  for (const fs::path& image : images) {
    const std::string stem = image.stem().string();
    const char* end = stem.data() + stem.size();
    double time = 0;
    const auto [rest, status] = std::from_chars(stem.data(), end, time, std::chars_format::fixed);
    if (status != std::errc{} || rest != end || stem.find('.') == stem.npos) return {};
    times.push_back(time);
  }
  return times;
}

Result<FrameLayout> find_in_folder(const fs::path& given) {
  const fs::path folder = given.has_filename() ? given : given.parent_path();
  std::error_code ignored;
  if (fs::exists(folder / "depth.txt", ignored)) return read_tum_list(folder / "depth.txt");
  FrameLayout layout;
  layout.folders = {folder};
  layout.whole_folder = true;
  auto images = images_in(folder);
  if (!images) return images.error();
  if (images->empty() && fs::is_directory(folder / "depth", ignored)) {
    images = images_in(folder / "depth");
    if (!images) return images.error();
    layout.folders = {folder / "depth", folder};
  } else if (fs::absolute(folder, ignored).filename() == "depth") {
    layout.folders.push_back(fs::absolute(folder, ignored).parent_path());
  }
  if (images->empty()) {
    return Error{ErrorCode::not_found,
                 "no depth images (PNG, PGM or TIFF) in this folder or its subfolder depth",
                 folder.string()};
  }
  layout.images = std::move(*images);
  layout.times = times_from_names(layout.images);
  return layout;
}

std::optional<fs::path> find_in(const std::vector<fs::path>& folders,
                                std::initializer_list<std::string_view> names) {
  for (const fs::path& folder : folders) {
    for (const std::string_view name : names) {
      std::error_code ignored;
      if (fs::is_regular_file(folder / name, ignored)) return folder / name;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<ImageList> read_image_list(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  ImageList list;
  Cursor cursor(file->text(), path.string(), {.blanks = " \t,", .comment = '#'});
  for (; cursor.next_filled_line(); cursor.next_line()) {
    double time = 0;
    if (!cursor.number(time) || !std::isfinite(time)) {
      return cursor.line_error("a timestamp and a file are expected");
    }
    const fs::path image = fs::path(cursor.word()).lexically_normal();
    if (image.empty() || image.is_absolute() || *image.begin() == "..") {
      return cursor.line_error("a file below the folder of this list is expected");
    }
    list.times.push_back(time);
    list.images.push_back(path.parent_path() / image);
  }
  if (list.images.empty()) return cursor.line_error("the list names no image");
  return list;
}

bool is_depth_image(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".png" || extension == ".pgm" || extension == ".tif" || extension == ".tiff";
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view x = take_digits(a), y = take_digits(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;
}

Result<FrameLayout> find_frames(const std::vector<fs::path>& inputs) {
  if (inputs.empty()) return Error{ErrorCode::invalid_argument, "no depth images are given", {}};
  FrameLayout layout;
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    if (!fs::exists(input, ignored)) {
      return Error{ErrorCode::not_found, "there is no such file or folder", input.string()};
    }
    if (fs::is_directory(input, ignored)) {
      if (inputs.size() == 1) return find_in_folder(input);
      return Error{ErrorCode::invalid_argument,
                   "a folder of frames is read alone, not together with other inputs",
                   input.string()};
    }
    layout.images.push_back(input);
  }
  layout.folders = {fs::absolute(inputs.front()).parent_path()};
  layout.times = times_from_names(layout.images);
  return layout;
}

std::optional<fs::path> find_beside(const FrameLayout& layout,
                                    std::initializer_list<std::string_view> names) {
  return find_in(layout.folders, names);
}

std::optional<fs::path> find_pose_list(const std::vector<fs::path>& folders) {
  return find_in(folders,
                 {"pose.txt", "poses.txt", "trajectory.log", "trajectory.txt", "groundtruth.txt"});
}

}  // namespace burnish
