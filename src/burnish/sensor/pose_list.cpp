#include "burnish/sensor/pose_list.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "burnish/io/cursor.h"
#include "burnish/io/file.h"

namespace burnish {
namespace {

constexpr double kLengthTolerance = 0.01;
constexpr double kMatrixTolerance = 1e-3;
constexpr std::size_t kShownLength = 40;  ///< of a word that is not what it should be
constexpr TextStyle kStyle{.blanks = " \t,", .comment = '#'};

/// The numbers on the rest of the line.
Result<std::vector<double>> numbers_on_line(Cursor& cursor) {
  std::vector<double> numbers;
  while (!cursor.at_line_end()) {
    double value = 0;
    if (!cursor.number(value)) {
      return cursor.line_error(
          fmt::format("'{}' is not a number", cursor.word().substr(0, kShownLength)));
    }
    if (!std::isfinite(value)) return cursor.line_error(fmt::format("{} is not finite", value));
    numbers.push_back(value);
  }
  return numbers;
}

/// The numbers of the next line that has any; none at the end of the file.
Result<std::vector<double>> next_numbers(Cursor& cursor) {
  return cursor.next_filled_line() ? numbers_on_line(cursor) : std::vector<double>{};
}

/// Passes a line `-`.
bool is_unknown(Cursor& cursor) {
  Cursor ahead = cursor;
  if (ahead.word() != "-" || !ahead.at_line_end()) return false;
  cursor = ahead;
  return true;
}

Error wrong_count(const Cursor& cursor, std::size_t count, std::string_view expected) {
  return cursor.line_error(fmt::format("{} numbers, {} expected", count, expected));
}

/// From `x y z qx qy qz qw`.
Result<RigidTransform> pose_from_quaternion(const Cursor& cursor, const double* n) {
  const double length = std::sqrt(n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6]);
  if (std::abs(length - 1) > kLengthTolerance) {
    return cursor.line_error(
        fmt::format("the quaternion ({}, {}, {}, {}) has length {:.4g}, not 1: it is no rotation",
                    n[3], n[4], n[5], n[6], length));
  }
  return rigid_from_quaternion(n[3], n[4], n[5], n[6], {n[0], n[1], n[2]});
}

/// From the next four lines of four numbers.
Result<RigidTransform> next_matrix(Cursor& cursor) {
  std::array<std::array<double, 4>, 4> m{};
  for (auto& row : m) {
    const auto numbers = next_numbers(cursor);
    if (!numbers) return numbers.error();
    if (numbers->empty()) return cursor.line_error("the file ends within a 4 x 4 matrix");
    if (numbers->size() != 4) return wrong_count(cursor, numbers->size(), "a matrix row of 4");
    for (std::size_t i = 0; i < 4; ++i) row[i] = (*numbers)[i];
  }
  RigidTransform pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.rows[i] = {m[i][0], m[i][1], m[i][2]};
    pose.translation[i] = m[i][3];
  }
  const double bottom = std::abs(m[3][0]) + std::abs(m[3][1]) + std::abs(m[3][2]);
  // The negation also refuses the NaN that overflowing numbers give.
  if (!(bottom + std::abs(m[3][3] - 1) < kMatrixTolerance)) {
    return cursor.line_error("the last row of the matrix is not 0 0 0 1");
  }
  const double defect = rotation_defect(pose);
  if (!(defect < kMatrixTolerance)) {
    return cursor.line_error(
        fmt::format("the matrix that ends here is no rotation (off by {:.3g}, allowed {})", defect,
                    kMatrixTolerance));
  }
  return pose;
}

Result<void> append_quaternion_line(const Cursor& cursor, const std::vector<double>& numbers,
                                    std::size_t columns, PoseList& list) {
  if (numbers.size() != columns) {
    return wrong_count(cursor, numbers.size(), fmt::format("{} as on the first line", columns));
  }
  const bool timed = columns == 8;
  const auto pose = pose_from_quaternion(cursor, numbers.data() + (timed ? 1 : 0));
  if (!pose) return pose.error();
  list.poses.push_back(*pose);
  if (timed) list.times.push_back(numbers[0]);
  return {};
}

}  // namespace

std::string pose_list_text(std::span<const std::optional<RigidTransform>> poses,
                           std::span<const std::string> comments) {
  std::string text;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i]) {
      const auto [qx, qy, qz, qw] = quaternion(*poses[i]);
      const Vec3d& t = poses[i]->translation;
      text += fmt::format("{} {} {} {} {} {} {}", t.x, t.y, t.z, qx, qy, qz, qw);
    } else {
      text += "-";
    }
    if (i < comments.size() && !comments[i].empty()) text += "  # " + comments[i];
    text += "\n";
  }
  return text;
}

Result<PoseList> read_pose_list(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  Cursor cursor(file->text(), path.string(), kStyle);
  PoseList list;
  std::size_t columns = 0;
  while (cursor.next_filled_line()) {
    if (is_unknown(cursor)) {
      list.unknown.resize(list.poses.size(), false);
      list.unknown.push_back(true);
      list.poses.emplace_back();
      continue;
    }
    const auto numbers = numbers_on_line(cursor);
    if (!numbers) return numbers.error();
    if (columns == 0) columns = numbers->size();
    if (columns == 7 || columns == 8) {
      if (auto line = append_quaternion_line(cursor, *numbers, columns, list); !line) {
        return line.error();
      }
    } else if (columns == 3 && numbers->size() == 3) {
      const auto pose = next_matrix(cursor);
      if (!pose) return pose.error();
      list.poses.push_back(*pose);
    } else {
      return wrong_count(cursor, numbers->size(),
                         "7 (x y z qx qy qz qw), 8 (with a timestamp before them) or 3 (before a "
                         "4 x 4 matrix)");
    }
  }
  if (columns == 0) return Error{ErrorCode::bad_file, "there is no pose in it", path.string()};
  if (!list.unknown.empty()) {
    if (columns != 7) {
      return Error{ErrorCode::bad_file, "only in lists of x y z qx qy qz qw can a pose be unknown",
                   path.string()};
    }
    list.unknown.resize(list.poses.size(), false);
  }
  list.format = columns == 7   ? "position and quaternion"
                : columns == 8 ? "TUM trajectory"
                               : "Redwood trajectory";
  return list;
}

Result<RigidTransform> read_pose_matrix(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  Cursor cursor(file->text(), path.string(), kStyle);
  auto pose = next_matrix(cursor);
  if (!pose) return pose;
  cursor.next_line();
  if (cursor.next_filled_line()) return cursor.line_error("the file goes on after a 4 x 4 matrix");
  return pose;
}

std::string pose_matrix_text(const RigidTransform& pose) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& row = pose.rows[i];
    text += fmt::format("{} {} {} {}\n", row.x, row.y, row.z, pose.translation[i]);
  }
  return text + "0 0 0 1\n";
}

}  // namespace burnish
