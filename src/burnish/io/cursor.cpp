#include "burnish/io/cursor.h"

#include <utility>

namespace burnish {

Cursor::Cursor(std::string_view bytes, std::string name, const TextStyle& style)
    : begin_(bytes.data()), at_(begin_), end_(begin_ + bytes.size()), name_(std::move(name)) {
  const auto set = [&](char c, Kind kind) { kinds_[static_cast<unsigned char>(c)] = kind; };
  for (const char c : style.blanks) set(c, Kind::blank);
  if (style.comment) set(style.comment, Kind::comment);
  if (style.continuation) set(style.continuation, Kind::continuation);
  set('\n', Kind::line_end);
  set('\r', Kind::line_end);
}

void Cursor::skip_line_end() {
  if (at_ == end_) return;
  const bool carriage_return = *at_++ == '\r';
  if (carriage_return && at_ != end_ && *at_ == '\n') ++at_;
  ++line_;
}

/// At a continuation character: goes to the last character of the line's end behind it, if there is
/// one.
bool Cursor::join_lines() {
  if (end_ - at_ < 2 || (at_[1] != '\n' && at_[1] != '\r')) return false;
  ++at_;
  skip_line_end();
  --at_;
  return true;
}

void Cursor::next_line() {
  bool commented = false;
  for (; at_ != end_; ++at_) {
    const Kind here = kind();
    if (here == Kind::line_end) break;
    if (here == Kind::comment) commented = true;
    if (here == Kind::continuation && !commented) join_lines();
  }
  skip_line_end();
}

std::string_view Cursor::word() {
  skip_blanks();
  const char* first = at_;
  while (at_ != end_ && (kind() == Kind::word || kind() == Kind::continuation)) {
    if (kind() == Kind::continuation && end_ - at_ > 1 && (at_[1] == '\n' || at_[1] == '\r')) break;
    ++at_;
  }
  return {first, static_cast<std::size_t>(at_ - first)};
}

std::string_view Cursor::rest_of_line() {
  skip_blanks();
  const char* first = at_;
  while (at_ != end_ && kind() != Kind::line_end) ++at_;
  const char* last = at_;
  while (last != first && kinds_[static_cast<unsigned char>(last[-1])] == Kind::blank) --last;
  return {first, static_cast<std::size_t>(last - first)};
}

bool Cursor::line_of_integers(std::span<std::uint32_t> values) {
  const char* at = at_;
  for (std::uint32_t& value : values) {
    while (at != end_ && kinds_[static_cast<unsigned char>(*at)] == Kind::blank) ++at;
    const char* first = at;
    std::uint32_t number = 0;
    for (; at != end_ && *at >= '0' && *at <= '9'; ++at)
      number = number * 10 + static_cast<std::uint32_t>(*at - '0');
    if (at == first || at - first > 9 || !ends_word(at)) return false;
    value = number;
  }
  while (at != end_ && kinds_[static_cast<unsigned char>(*at)] == Kind::blank) ++at;
  if (at != end_ && kinds_[static_cast<unsigned char>(*at)] != Kind::line_end) return false;
  at_ = at;
  skip_line_end();
  return true;
}

/// The numbers that from_chars leaves: too small for a float (0) or written in another type's way.
bool Cursor::rare_number(double& value) {
  const char* start = at_;
  std::string_view text = word();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* last = text.data() + text.size();
  auto [stop, status] = std::from_chars(text.data(), last, value);
  if (status == std::errc::result_out_of_range && stop == last) {
    // Out of the range of a double: too small is 0, too large is refused.
    const std::size_t exponent = text.find_first_of("eE");
    if (exponent != text.npos && exponent + 1 < text.size() && text[exponent + 1] == '-') {
      value = 0;
      return true;
    }
  }
  if (text.empty() || status != std::errc{} || stop != last) {
    at_ = start;
    return false;
  }
  return true;
}

std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text) c = c >= ' ' && c < 127 ? c : '?';
  return text;
}

}  // namespace burnish
