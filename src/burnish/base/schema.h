#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "burnish/base/quantity.h"
#include "burnish/base/result.h"

namespace burnish {

/// The texts that a user gave for some keys: {{"iterations", "20"}, {"lambda", "0.5"}}.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// A parameter as help texts, documentation and Python show it.
struct FieldInfo {
  std::string key;
  std::string type;  ///< "integer", "number", "length", "angle", "time", "flag" or "choice"
  std::string default_value;  ///< as the user would type it
  std::string range;          ///< "[0, 1]", "(0, inf)", "fixed | free"
  std::string unit;
  std::string help;  ///< half a sentence, lower case, no full stop
};

/// Lower and upper limit of a number; open: the limit itself is not allowed.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;

  bool contains(double value) const {
    return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
  }
  std::string text() const;
};

inline Range at_least(double low) {
  return {low};
}
inline Range more_than(double low) {
  return {.low = low, .open_low = true};
}
inline Range between(double low, double high) {
  return {low, high};
}

namespace schema_detail {
Result<int> parse_integer(std::string_view text);
Result<bool> parse_flag(std::string_view text);
Error unknown_choice(std::string_view text, std::string_view all);
Error out_of_range(std::string_view key, const std::string& value, const std::string& range);
Error unknown_key(std::string_view key, const std::vector<FieldInfo>& fields);
Error in_field(std::string_view key, Error error);
}  // namespace schema_detail

/// The fields of a parameter struct: how each is called, read, checked and explained. Defaults are
/// the struct's own. One Schema serves the program's options, help, recipes, Python and the checks.
template <class Params>
class Schema {
 public:
  Schema& integer(std::string key, int Params::*member, Range range, std::string help) {
    return add(std::move(key), "integer", "", range.text(), std::move(help),
               {[member](Params& p, std::string_view text) -> Result<void> {
                  const auto value = schema_detail::parse_integer(text);
                  if (!value) return value.error();
                  p.*member = *value;
                  return {};
                },
                [member](const Params& p) { return std::to_string(p.*member); },
                [member, range](const Params& p) { return range.contains(p.*member); }});
  }

  Schema& real(std::string key, double Params::*member, Range range, std::string help,
               Quantity quantity = Quantity::number) {
    static constexpr const char* kTypes[] = {"number", "length", "angle", "time"};
    return add(std::move(key), kTypes[static_cast<int>(quantity)], std::string(unit_of(quantity)),
               range.text(), std::move(help),
               {[member, quantity](Params& p, std::string_view text) -> Result<void> {
                  const auto value = parse_quantity(text, quantity);
                  if (!value) return value.error();
                  p.*member = *value;
                  return {};
                },
                [member, quantity](const Params& p) { return quantity_text(p.*member, quantity); },
                [member, range](const Params& p) {
                  return std::isfinite(p.*member) && range.contains(p.*member);
                }});
  }

  Schema& flag(std::string key, bool Params::*member, std::string help) {
    return add(std::move(key), "flag", "", "true | false", std::move(help),
               {[member](Params& p, std::string_view text) -> Result<void> {
                  const auto value = schema_detail::parse_flag(text);
                  if (!value) return value.error();
                  p.*member = *value;
                  return {};
                },
                [member](const Params& p) { return std::string(p.*member ? "true" : "false"); },
                [](const Params&) { return true; }});
  }

  /// One of several names: .choice("boundary", &P::boundary, {{"fixed", Boundary::fixed}, ...},
  /// "...").
  template <class Enum>
  Schema& choice(std::string key, Enum Params::*member,
                 std::vector<std::pair<std::string, Enum>> names, std::string help) {
    std::string all;
    for (const auto& [name, value] : names) all += (all.empty() ? "" : " | ") + name;
    const auto name_of = [member, names](const Params& p) {
      for (const auto& [name, value] : names) {
        if (value == p.*member) return name;
      }
      return std::string();
    };
    return add(std::move(key), "choice", "", all, std::move(help),
               {[member, names, all](Params& p, std::string_view text) -> Result<void> {
                  for (const auto& [name, value] : names) {
                    if (name == text) {
                      p.*member = value;
                      return {};
                    }
                  }
                  return schema_detail::unknown_choice(text, all);
                },
                name_of, [name_of](const Params& p) { return !name_of(p).empty(); }});
  }

  /// The fields of a struct within the struct: .group(&P::weights, Weights::schema()).
  template <class Group>
  Schema& group(Group Params::*member, const Schema<Group>& schema) {
    for (std::size_t i = 0; i < schema.fields_.size(); ++i) {
      const typename Schema<Group>::Access& inner = schema.access_[i];
      const FieldInfo& field = schema.fields_[i];
      add(field.key, field.type, field.unit, field.range, field.help,
          {[member, read = inner.read](Params& p, std::string_view text) {
             return read(p.*member, text);
           },
           [member, text = inner.text](const Params& p) { return text(p.*member); },
           [member, valid = inner.valid](const Params& p) { return valid(p.*member); }});
    }
    return *this;
  }

  const std::vector<FieldInfo>& fields() const { return fields_; }

  /// Whether every field is in its range. Errors: invalid_argument that names the field.
  Result<void> check(const Params& params) const {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (!access_[i].valid(params)) {
        return schema_detail::out_of_range(fields_[i].key, access_[i].text(params),
                                           fields_[i].range);
      }
    }
    return {};
  }

  /// The defaults with `settings` laid over them, checked. Errors: invalid_argument that names the
  /// field; an unknown key is answered with the known ones.
  Result<Params> parse(const Settings& settings) const {
    Params params;
    for (const auto& [key, text] : settings) {
      std::size_t i = 0;
      while (i < fields_.size() && fields_[i].key != key) ++i;
      if (i == fields_.size()) return schema_detail::unknown_key(key, fields_);
      if (auto read = access_[i].read(params, text); !read) {
        return schema_detail::in_field(key, std::move(read).error());
      }
    }
    if (auto valid = check(params); !valid) return valid.error();
    return params;
  }

  /// Every field and its value: what a recipe or a report keeps.
  Settings settings(const Params& params) const {
    Settings result;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      result.emplace_back(fields_[i].key, access_[i].text(params));
    }
    return result;
  }

 private:
  template <class Other>
  friend class Schema;

  struct Access {
    std::function<Result<void>(Params&, std::string_view)> read;
    std::function<std::string(const Params&)> text;
    std::function<bool(const Params&)> valid;
  };

  Schema& add(std::string key, std::string type, std::string unit, std::string range,
              std::string help, Access access) {
    const std::string default_value = access.text(Params{});
    fields_.push_back({std::move(key), std::move(type), default_value, std::move(range),
                       std::move(unit), std::move(help)});
    access_.push_back(std::move(access));
    return *this;
  }

  std::vector<FieldInfo> fields_;
  std::vector<Access> access_;
};

}  // namespace burnish
