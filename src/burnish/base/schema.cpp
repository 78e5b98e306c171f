#include "burnish/base/schema.h"

#include <fmt/format.h>

#include <charconv>

namespace burnish {

std::string Range::text() const {
  return fmt::format("{}{}, {}{}", open_low || std::isinf(low) ? '(' : '[', low, high,
                     open_high || std::isinf(high) ? ')' : ']');
}

namespace schema_detail {

Result<int> parse_integer(std::string_view text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, status] = std::from_chars(text.data(), end, value);
  if (status == std::errc{} && rest == end) return value;
  return Error{ErrorCode::invalid_argument, fmt::format("'{}' is not a whole number", text), {}};
}

Result<bool> parse_flag(std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return Error{
      ErrorCode::invalid_argument, fmt::format("'{}' is neither true nor false", text), {}};
}

Error unknown_choice(std::string_view text, std::string_view all) {
  return {ErrorCode::invalid_argument, fmt::format("'{}' is not one of {}", text, all), {}};
}

Error out_of_range(std::string_view key, const std::string& value, const std::string& range) {
  return {ErrorCode::invalid_argument, fmt::format("{} is {}, allowed: {}", key, value, range), {}};
}

Error unknown_key(std::string_view key, const std::vector<FieldInfo>& fields) {
  std::string known;
  for (const FieldInfo& field : fields) known += (known.empty() ? "" : ", ") + field.key;
  return {ErrorCode::invalid_argument,
          known.empty() ? fmt::format("unknown parameter '{}', there are none", key)
                        : fmt::format("unknown parameter '{}', known: {}", key, known),
          {}};
}

Error in_field(std::string_view key, Error error) {
  error.message = fmt::format("{}: {}", key, error.message);
  return error;
}

}  // namespace schema_detail
}  // namespace burnish
