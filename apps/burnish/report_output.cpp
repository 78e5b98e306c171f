#include "report_output.h"

#include "burnish/report/report.h"
#include "summary.h"

namespace burnish::app {

void add_report_options(CLI::App* verb, ReportOutput& output) {
  verb->add_option("--report", output.page,
                   "write an HTML page with pictures and figures of every phase")
      ->type_name("FILE");
  verb->add_option("--pictures", output.pictures,
                   "write the page's pictures as PREFIX-VIEW-PHASE.png")
      ->type_name("PREFIX");
}

Result<void> check_report_output(const ReportOutput& output) {
  if (auto possible = check_folder_of(output.page); !possible) return possible;
  return check_folder_of(output.pictures);
}

Result<void> write_report_output(const ReportOutput& output, const Record& record,
                                 const Session& session, const Context& context) {
  if (!output.wanted()) return {};
  context.stage("painting pictures");
  const Result<Plates> plates = paint_plates(record, {}, context.part(0, 0.8));
  if (!plates) return plates.error();
  if (!output.page.empty()) {
    if (auto written = write_report(output.page, record, *plates, context.part(0.8, 0.9)); !written)
      return written;
    say(session, "report: " + output.page);
  }
  if (!output.pictures.empty()) {
    const auto paths = write_pictures(output.pictures, record, *plates, context.part(0.9, 1));
    if (!paths) return paths.error();
    for (const auto& path : *paths) say(session, "picture: " + path.string());
  }
  return {};
}

}  // namespace burnish::app
