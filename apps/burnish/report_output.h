#pragma once

#include "burnish/pipeline/record.h"
#include "verb.h"

namespace burnish::app {

/// Where the user wants to see what was done.
struct ReportOutput {
  std::string page, pictures;

  bool wanted() const { return !page.empty() || !pictures.empty(); }
};

/// Adds --report and --pictures to a verb.
void add_report_options(CLI::App* verb, ReportOutput& output);

/// Whether the folders to write to are there. Errors: not_found.
Result<void> check_report_output(const ReportOutput& output);

/// Paints the record's phases and writes what is wanted; says where it is.
Result<void> write_report_output(const ReportOutput& output, const Record& record,
                                 const Session& session, const Context& context);

}  // namespace burnish::app
