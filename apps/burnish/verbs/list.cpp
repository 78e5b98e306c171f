#include <fmt/format.h>

#include <algorithm>

#include "../verb.h"

namespace burnish::app {

Action add_list(CLI::App& app) {
  auto* verb = app.add_subcommand("list", "List the methods and their parameters.");
  auto family = std::make_shared<std::string>();
  verb->add_option(
      "FAMILY", *family,
      "one of average, filter, clean, merge, fuse, thin, triangulate, repair, smooth, simplify, "
      "refine; all where left out");
  verb->footer("Example:\n  burnish list smooth");
  return [family](const Session&, const Context&) -> Result<void> {
    const auto known = families();
    if (!family->empty() && std::find(known.begin(), known.end(), *family) == known.end()) {
      return Error{
          ErrorCode::invalid_argument,
          fmt::format("'{}' is no family of methods, known: {}", *family, fmt::join(known, ", ")),
          {}};
    }
    for (const std::string_view name : known) {
      if (family->empty() || *family == name) fmt::print("{}\n{}\n", name, methods_help(name));
    }
    return {};
  };
}

}  // namespace burnish::app
