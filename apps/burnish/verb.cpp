#include "verb.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "burnish/pipeline/recipe.h"

namespace burnish::app {
namespace {

/// A length in the unit in which it has one to three digits before the point.
std::string readable_length(double metres) {
  const double size = std::abs(metres);
  if (size == 0) return "0 m";
  if (size < 1e-3) return fmt::format("{:.4g} um", metres * 1e6);
  if (size < 1) return fmt::format("{:.4g} mm", metres * 1e3);
  return fmt::format("{:.4g} m", metres);
}

}  // namespace

void say(const Session& session, const std::string& line) {
  if (!session.quiet) fmt::print("{}\n", line);
}

std::string readable(const Fact& fact) {
  if (fact.unit == "m") return readable_length(fact.value);
  if (fact.unit == "rad") return fmt::format("{:.4g} deg", fact.value * 180 / std::numbers::pi);
  const bool whole = fact.value == std::floor(fact.value) && std::abs(fact.value) < 1e15;
  const std::string number =
      whole ? fmt::format("{:.0f}", fact.value) : fmt::format("{:.5g}", fact.value);
  return fact.unit.empty() ? number : number + " " + fact.unit;
}

std::string methods_help(std::string_view family) {
  std::string text;
  for (const OperationInfo& info : operations_of(family)) {
    text += fmt::format("  {}\n      {}\n", info.name, info.summary);
    for (const FieldInfo& field : info.fields) {
      text += fmt::format("      {}={}  {}; {}{}{}\n", field.key, field.default_value, field.help,
                          field.range, field.unit.empty() ? "" : " ", field.unit);
    }
  }
  return text;
}

CLI::Option* add_method(CLI::App* verb, const std::string& name, std::vector<std::string>& methods,
                        std::string_view family, const std::string& help) {
  return verb->add_option(name, methods, help)
      ->type_name("METHOD")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->default_str("")
      ->description(help + fmt::format(" (burnish list {})", family));
}

void add_fields(CLI::App* verb, const std::vector<FieldInfo>& fields, Settings& settings) {
  for (const FieldInfo& field : fields) {
    verb->add_option_function<std::string>(
            "--" + field.key,
            [&settings, key = field.key](const std::string& text) {
              settings.emplace_back(key, text);
            },
            fmt::format("{}; {}{}{}, default {}", field.help, field.range,
                        field.unit.empty() ? "" : " ", field.unit, field.default_value))
        ->type_name(field.type);
  }
}

void add_bound(CLI::App* verb, std::string& bound) {
  const FieldInfo c = NoiseBoundParams::schema().fields().front();
  verb->add_option("--bound", bound,
                   fmt::format("noise[:{}={}]: no vertex goes farther than {} standard deviations "
                               "from its measurement, whatever the method; needs noise or sigma "
                               "of every vertex",
                               c.key, c.default_value, c.key))
      ->type_name("BOUND");
}

Result<std::optional<NoiseBoundParams>> bound_of(const std::string& text) {
  if (text.empty()) return std::optional<NoiseBoundParams>();
  const Result<NoiseBoundParams> params = parse_bound(text);
  if (!params) return params.error();
  return std::optional(*params);
}

Result<std::vector<Method>> parse_methods(const std::vector<std::string>& texts) {
  std::vector<Method> methods;
  for (const std::string& text : texts) {
    Result<Method> method = parse_method(text);
    if (!method) return std::move(method).error();
    methods.push_back(*std::move(method));
  }
  return methods;
}

Result<std::optional<Region>> parse_region_option(const std::string& text, const char* option) {
  if (text.empty()) return std::optional<Region>();
  const Result<Region> region = parse_region(text);
  if (!region) return Error{region.error().code, region.error().message, option};
  return std::optional<Region>(*region);
}

}  // namespace burnish::app
