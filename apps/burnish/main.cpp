// burnish: depth-camera scans in, clean triangle meshes out. One verb a job; each verb is a file in
// verbs/.
#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "burnish/base/version.h"
#include "heap.h"
#include "interrupt.h"
#include "terminal.h"
#include "verb.h"

namespace burnish::app {
namespace {

std::string typed_command(int count, char** words) {
  std::string text = "burnish";
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const bool plain =
        !word.empty() && word.find_first_of(" \t\n'\"\\$*?()[]{}<>|&;#~`") == std::string::npos;
    text += plain ? " " + word : " '" + word + "'";
  }
  return text;
}

int run(int count, char** words) {
  Session session;
  CLI::App app{"burnish turns depth-camera scans into clean triangle meshes."};
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", fmt::format("burnish {}", kVersion));
  app.add_flag("-q,--quiet", session.quiet, "print nothing but errors");
  app.add_option("--threads", session.threads, "use at most N threads; results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.footer(
      "Example:\n  burnish reconstruct scan/ -o model.ply --report report.html\n"
      "Methods are written NAME[:key=value,...]; `burnish list` names them all.");

  const std::vector<Action> actions{add_reconstruct(app), add_triangulate(app), add_repair(app),
                                    add_smooth(app),      add_simplify(app),    add_refine(app),
                                    add_adapt(app),       add_progressive(app), add_extract(app),
                                    add_verify(app),      add_convert(app),     add_measure(app),
                                    add_simulate(app),    add_reproduce(app),   add_list(app)};
  try {
    app.parse(count, words);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::RequiredError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) {
      return fail({ErrorCode::invalid_argument,
                   fmt::format("'{}' is no verb; burnish --help lists them", unknown.front()),
                   {}});
    }
    app.exit(error);
    return exit_status(ErrorCode::invalid_argument);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return exit_status(ErrorCode::invalid_argument);
  }

  const Interrupt interrupt;
  session.command = typed_command(count, words);
  const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
  for (std::size_t i = 0; i < verbs.size(); ++i) {
    if (!verbs[i]->parsed()) continue;
    TerminalProgress progress(session.quiet);
    Context context;
    context.stop = interrupt.token();
    context.sink = &progress;
    context.threads = session.threads;
    const Result<void> done = actions[i](session, context);
    if (!done) return fail(done.error());
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    return fail({ErrorCode::io_failure, "standard output could not be written", {}});
  }
  return 0;
}

}  // namespace
}  // namespace burnish::app

int main(int count, char** words) {
  burnish::app::prepare_heap();
  try {
    return burnish::app::run(count, words);
  } catch (const std::bad_alloc&) {
    return burnish::app::fail({burnish::ErrorCode::out_of_memory, "not enough memory", {}});
  } catch (const std::system_error& error) {  // fmt could not write to a stream
    return burnish::app::fail({burnish::ErrorCode::io_failure, error.what(), {}});
  } catch (const std::exception& error) {
    fmt::print(stderr, "burnish: {}\n", error.what());
    return 1;
  }
}
