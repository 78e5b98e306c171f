#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/catalogue/operations.h"
#include "burnish/pipeline/region.h"
#include "burnish/smoothing/noise_bound.h"

namespace burnish::app {

/// What every verb is run with.
struct Session {
  bool quiet = false;
  int threads = 0;
  std::string command;  ///< the command line as it was typed
  std::stop_token stop;
};

/// What a verb does once the command line is read.
using Action = std::function<Result<void>(const Session&, const Context&)>;

/// Each adds one verb to the program and returns what it does.
Action add_register(CLI::App& app);
Action add_reconstruct(CLI::App& app);
Action add_triangulate(CLI::App& app);
Action add_repair(CLI::App& app);
Action add_smooth(CLI::App& app);
Action add_simplify(CLI::App& app);
Action add_refine(CLI::App& app);
Action add_adapt(CLI::App& app);
Action add_progressive(CLI::App& app);
Action add_extract(CLI::App& app);
Action add_verify(CLI::App& app);
Action add_convert(CLI::App& app);
Action add_measure(CLI::App& app);
Action add_simulate(CLI::App& app);
Action add_import(CLI::App& app);
Action add_reproduce(CLI::App& app);
Action add_list(CLI::App& app);

/// Prints to standard output unless the session is quiet.
void say(const Session& session, const std::string& line);

/// "12.3 mm", "3.1°", "0.52": a fact's value as people read it.
std::string readable(const Fact& fact);

/// The methods of a family with their parameters, for the end of a help text.
std::string methods_help(std::string_view family);

/// Adds an option that takes NAME[:key=value,...]; the method is looked up when the verb runs.
CLI::Option* add_method(CLI::App* verb, const std::string& name, std::vector<std::string>& methods,
                        std::string_view family, const std::string& help);

/// Adds an option --KEY for every field; what is given goes into `settings`, which must outlive the
/// parsing.
void add_fields(CLI::App* verb, const std::vector<FieldInfo>& fields, Settings& settings);

/// Adds --bound to a verb that smooths.
void add_bound(CLI::App* verb, std::string& bound);

/// What --bound says; nothing where it was not given. Errors: invalid_argument.
Result<std::optional<NoiseBoundParams>> bound_of(const std::string& text);

/// The methods written in `texts`. Errors: invalid_argument.
Result<std::vector<Method>> parse_methods(const std::vector<std::string>& texts);

/// The region that `option` was given as `text`; none where it was not given. Errors:
/// invalid_argument.
Result<std::optional<Region>> parse_region_option(const std::string& text, const char* option);

}  // namespace burnish::app
