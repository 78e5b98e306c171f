#include "burnish/pipeline/progressive_columns.h"

#include <cstring>
#include <utility>

#include "burnish/base/vec3.h"
#include "burnish/pipeline/progressive_bytes.h"

namespace burnish {
namespace {

constexpr std::size_t kFixed = 6;  ///< attributes that are no channels
constexpr std::uint8_t kAbsent = 0x80;

/// Calls `use(column)` for every array of attributes, in the order of the row.
template <class Attributes, class Use>
void for_each_column(Attributes& attributes, Use use) {
  use(attributes.normals);
  use(attributes.colors);
  use(attributes.sigma);
  use(attributes.noise);
  use(attributes.observations);
  use(attributes.origin);
  for (auto& channel : attributes.channels) std::visit(use, channel.values);
}

template <class Column>
constexpr std::size_t size_of_one(const Column&) {
  return sizeof(typename Column::value_type);
}

template <std::size_t... types>
Channel::Values empty_values(std::size_t type, std::index_sequence<types...>) {
  Channel::Values values;
  ((type == types ? static_cast<void>(values.emplace<types>()) : static_cast<void>(0)), ...);
  return values;
}

constexpr std::size_t kChannelTypes = std::variant_size_v<Channel::Values>;

}  // namespace

ProgressiveColumns::ProgressiveColumns(const TriangleMesh& mesh)
    : triangle_origin_(!mesh.triangle_attributes.origin.empty()),
      triangle_owner_(!mesh.triangle_attributes.owner.empty()) {
  for_each_column(mesh.attributes,
                  [&](const auto& column) { present_.push_back(column.empty() ? 0 : 1); });
  for (const Channel& channel : mesh.attributes.channels) {
    attributes_.channels.push_back(
        {channel.name,
         empty_values(channel.values.index(), std::make_index_sequence<kChannelTypes>())});
  }
  find_row_size();
}

void ProgressiveColumns::find_row_size() {
  row_size_ = sizeof(Vec3f);
  std::size_t k = 0;
  for_each_column(attributes_, [&](const auto& column) {
    if (present_[k++] != 0) row_size_ += size_of_one(column);
  });
}

void ProgressiveColumns::put_list(std::string& bytes) const {
  unsigned flags = 0;
  for (std::size_t k = 0; k < kFixed; ++k) flags |= static_cast<unsigned>(present_[k]) << k;
  if (triangle_origin_) flags |= 1u << kFixed;
  if (triangle_owner_) flags |= 1u << (kFixed + 1);
  bytes += static_cast<char>(flags);
  put_number(bytes, attributes_.channels.size());
  for (std::size_t c = 0; c < attributes_.channels.size(); ++c) {
    const Channel& channel = attributes_.channels[c];
    const auto type = static_cast<std::uint8_t>(channel.values.index());
    bytes += static_cast<char>(type | (present_[kFixed + c] != 0 ? 0 : kAbsent));
    put_number(bytes, channel.name.size());
    bytes += channel.name;
  }
}

bool ProgressiveColumns::read_list(Cursor& cursor) {
  std::uint8_t flags = 0;
  std::uint64_t channels = 0;
  // A channel takes two bytes at least.
  if (!cursor.read(flags) || !read_number(cursor, cursor.remaining() / 2 + 1, channels))
    return false;
  for (std::size_t k = 0; k < kFixed; ++k) present_.push_back(flags >> k & 1);
  triangle_origin_ = (flags >> kFixed & 1) != 0;
  triangle_owner_ = (flags >> (kFixed + 1) & 1) != 0;
  for (std::uint64_t c = 0; c < channels; ++c) {
    std::uint8_t type = 0;
    std::uint64_t length = 0;
    if (!cursor.read(type) || (type & ~kAbsent) >= static_cast<int>(kChannelTypes)) return false;
    if (!read_number(cursor, cursor.remaining() + 1, length)) return false;
    const std::byte* name = cursor.take(length);
    if (!name) return false;
    present_.push_back((type & kAbsent) != 0 ? 0 : 1);
    attributes_.channels.push_back(
        {std::string(reinterpret_cast<const char*>(name), length),
         empty_values(type & ~kAbsent, std::make_index_sequence<kChannelTypes>())});
  }
  find_row_size();
  return true;
}

void ProgressiveColumns::reserve(std::size_t vertices) {
  positions_.reserve(vertices);
  std::size_t k = 0;
  for_each_column(attributes_, [&](auto& column) {
    if (present_[k++] != 0) column.reserve(vertices);
  });
}

bool ProgressiveColumns::append(const std::byte* row) {
  const auto take_into = [&](auto& column) {
    typename std::remove_reference_t<decltype(column)>::value_type value;
    std::memcpy(&value, row, sizeof(value));
    row += sizeof(value);
    column.push_back(value);
  };
  take_into(positions_);
  std::size_t k = 0;
  for_each_column(attributes_, [&](auto& column) {
    if (present_[k++] != 0) take_into(column);
  });
  return is_finite(positions_.back()) &&
         (attributes_.origin.empty() || attributes_.origin.back() <= Origin::invented);
}

void ProgressiveColumns::reorder(std::span<const std::uint32_t> order) {
  positions_ = reordered(positions_, order);
  for_each_column(attributes_, [&](auto& column) { column = reordered(column, order); });
}

void put_row(std::string& bytes, const TriangleMesh& mesh, std::size_t v) {
  put_raw(bytes, mesh.positions[v]);
  for_each_column(mesh.attributes, [&](const auto& column) {
    if (!column.empty()) put_raw(bytes, column[v]);
  });
}

}  // namespace burnish
