#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

#include "burnish/io/crc32.h"
#include "burnish/io/file.h"
#include "burnish/pipeline/progressive_file.h"
#include "burnish/pipeline/progressive_head.h"
#include "burnish/pipeline/progressive_records.h"

namespace burnish {
namespace {

class ProgressiveReader {
 public:
  ProgressiveReader(std::string_view bytes, const std::string& name, const ProgressiveStop& stop,
                    const Context& context)
      : bytes_(bytes), cursor_(bytes, name), name_(name), stop_(stop), context_(context) {}

  /// Grows the mesh up to the level; keeps the removals, the last one first, where `log`.
  Result<void> read(bool log);

  /// What was read, in the order of the original. The bytes are not needed for it.
  Result<ProgressiveContent> content() &&;

 private:
  GrownMesh& grown() { return head_.coarse; }
  std::uint64_t records() const { return head_.file.vertices - head_.file.coarse_vertices; }
  std::uint64_t triangles() const { return head_.coarse.mesh.stars.triangles(); }
  bool wants_more() const {
    return (!stop_.triangles || triangles() < *stop_.triangles) &&
           (!stop_.error || error_ > *stop_.error);
  }
  bool keep_going() const;
  Error bad_record(std::size_t begin, const std::string& what) const;
  template <class Check>
  bool check_agrees();
  Result<bool> read_record();
  bool make_split(const std::byte* row);
  Result<void> read_end();

  std::string_view bytes_;
  Cursor cursor_;
  std::string name_;
  const ProgressiveStop& stop_;
  const Context& context_;
  Crc32 crc_;
  std::size_t in_crc_ = 0;  ///< bytes of the file
  ProgressiveHead head_;
  OriginalSize original_;
  VertexSplit split_;
  float error_ = 0;
  std::uint64_t records_read_ = 0;
  std::size_t bytes_read_ = 0;
  std::vector<Removal> removals_;  ///< in numbers of the growing mesh
  std::vector<std::string> notes_;
};

bool ProgressiveReader::keep_going() const {
  const double bytes = static_cast<double>(cursor_.offset()) / static_cast<double>(bytes_.size());
  const double grown =
      stop_.triangles && *stop_.triangles > 0
          ? static_cast<double>(triangles()) / static_cast<double>(*stop_.triangles)
          : 0;
  context_.progress(std::min(1.0, std::max(bytes, grown)) * 0.8);
  return !context_.cancelled();
}

Error ProgressiveReader::bad_record(std::size_t begin, const std::string& what) const {
  return {
      ErrorCode::bad_file,
      fmt::format(
          "record {} of {} is damaged or cut off ({}); a level of up to {} triangles can be had",
          records_read_ + 1, records(), what, triangles()),
      fmt::format("{}, byte {}", name_, begin)};
}

/// Whether what follows is the check of all bytes before it.
template <class Check>
bool ProgressiveReader::check_agrees() {
  crc_.add(bytes_.data() + in_crc_, cursor_.offset() - in_crc_);
  in_crc_ = cursor_.offset();
  Check claim = 0;
  if (!cursor_.read(claim)) return false;
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return true;  // or a fuzzer would hardly ever get beyond the first
#else
  return claim == static_cast<Check>(crc_.value());
#endif
}

/// Reads a record and makes its split; false where that would be more than was asked for.
Result<bool> ProgressiveReader::read_record() {
  const std::size_t begin = cursor_.offset();
  const std::byte* row = nullptr;
  const char* wrong =
      read_split(cursor_, grown().mesh, error_, grown().columns, original_, split_, row);
  if (wrong) return bad_record(begin, wrong);
  if (!check_agrees<std::uint16_t>()) return bad_record(begin, "its check does not agree");
  if (stop_.triangles && triangles() + split_.returning_count > *stop_.triangles) return false;
  if (!make_split(row)) return bad_record(begin, "a position that is not finite, or no origin");
  return true;
}

bool ProgressiveReader::make_split(const std::byte* row) {
  for (std::size_t i = 0; i < split_.returning_count; ++i) {
    if (grown().columns.triangle_origin())
      grown().triangle_origin.push_back(split_.returning[i].origin);
    if (grown().columns.triangle_owner())
      grown().triangle_owner.push_back(split_.returning[i].owner);
  }
  grown().mesh.split(split_);
  return grown().columns.append(row);
}

Result<void> ProgressiveReader::read_end() {
  if (records_read_ < records()) {
    notes_.push_back(
        fmt::format("the file ends behind record {} of {}: the finest level is not in it",
                    records_read_, records()));
    return {};
  }
  if (triangles() != original_.triangles) {
    return cursor_.byte_error(
        fmt::format("{} triangles were claimed, {} came", original_.triangles, triangles()));
  }
  if (cursor_.at_end()) {
    notes_.emplace_back("the file ends before its last check");
    return {};
  }
  const std::size_t begin = cursor_.offset();
  if (!check_agrees<std::uint32_t>()) {
    return Error{ErrorCode::bad_file,
                 "the check at the end of the file is cut off or does not agree",
                 fmt::format("{}, byte {}", name_, begin)};
  }
  if (!cursor_.at_end()) return cursor_.byte_error("the file goes on behind its end");
  return {};
}

Result<void> ProgressiveReader::read(bool log) {
  auto head = read_progressive_head(cursor_, stop_, [this] { return keep_going(); });
  if (!head) return head.error();
  head_ = *std::move(head);
  head_.file.bytes = bytes_.size();
  original_ = {head_.file.vertices, head_.file.triangles};
  error_ = head_.file.coarse_error;
  const std::size_t check = cursor_.offset();
  if (!check_agrees<std::uint32_t>()) {
    return Error{
        ErrorCode::bad_file,
        "the check of the coarse mesh, of all bytes before it, is cut off or does not agree",
        fmt::format("{}, byte {}", name_, check)};
  }
  if (log) removals_.reserve(std::min<std::uint64_t>(records(), cursor_.remaining() / 21));
  bytes_read_ = cursor_.offset();
  while (records_read_ < records() && wants_more() && !cursor_.at_end()) {
    if (records_read_ % 4096 == 0 && !keep_going()) return cancelled();
    const float before = error_;
    const Result<bool> grew = read_record();
    if (!grew) return grew.error();
    if (!*grew) return {};
    if (log) {
      const auto vertex = static_cast<std::uint32_t>(grown().mesh.stars.vertices() - 1);
      removals_.push_back({vertex, split_.into, before});
    }
    error_ = split_.error;
    ++records_read_;
    bytes_read_ = cursor_.offset();
  }
  if (records_read_ == records() || (cursor_.at_end() && wants_more())) {
    if (auto ok = read_end(); !ok) return ok;
    bytes_read_ = cursor_.offset();
  }
  return {};
}

Result<ProgressiveContent> ProgressiveReader::content() && {
  const bool whole = records_read_ == records();
  if (!whole && grown().columns.triangle_owner())
    notes_.emplace_back("the owners of triangles come with the original only: left out");
  auto ordered = in_original_order(std::move(head_.coarse), whole);
  if (!ordered) {
    ordered.error().where = name_;
    return ordered.error();
  }
  ordered->mesh.frame = head_.frame;
  for (Removal& removal : removals_) {
    removal.vertex = ordered->places[removal.vertex];
    removal.into = ordered->places[removal.into];
  }
  std::reverse(removals_.begin(), removals_.end());
  ProgressiveLevel level{
      std::move(ordered->mesh), error_, records_read_, bytes_read_, head_.file, whole,
      std::move(notes_)};
  return ProgressiveContent{std::move(level), std::move(removals_)};
}

Result<void> check_stop(const ProgressiveStop& stop) {
  if (!stop.error || *stop.error >= 0) return {};
  return Error{ErrorCode::invalid_argument,
               fmt::format("an error of 0 or more was expected, {} came", *stop.error),
               {}};
}

/// `file` is where the bytes are, if it is one: it is let go of as soon as they are read.
Result<ProgressiveContent> read_content(std::string_view bytes, const std::string& name,
                                        const ProgressiveStop& stop, bool log,
                                        const Context& context, FileBytes* file) {
  if (auto ok = check_stop(stop); !ok) return ok.error();
  try {
    ProgressiveReader reader(bytes, name, stop, context);
    if (auto ok = reader.read(log); !ok) return ok.error();
    if (file) *file = FileBytes();
    auto content = std::move(reader).content();
    if (content) context.progress(1);
    return content;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "the level does not fit into memory", name};
  }
}

}  // namespace

Result<ProgressiveLevel> read_progressive(const std::filesystem::path& path,
                                          const ProgressiveStop& stop, const Context& context) {
  auto file = map_file(path);
  if (!file) return file.error();
  auto content = read_content(file->text(), path.string(), stop, false, context, &*file);
  if (!content) return content.error();
  return std::move(content->level);
}

Result<ProgressiveLevel> parse_progressive(std::string_view bytes, const std::string& name,
                                           const ProgressiveStop& stop, const Context& context) {
  auto content = read_content(bytes, name, stop, false, context, nullptr);
  if (!content) return content.error();
  return std::move(content->level);
}

Result<ProgressiveContent> read_progressive_all(const std::filesystem::path& path,
                                                const Context& context) {
  auto file = map_file(path);
  if (!file) return file.error();
  return read_content(file->text(), path.string(), {}, true, context, &*file);
}

}  // namespace burnish
