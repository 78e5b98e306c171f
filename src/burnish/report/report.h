#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "burnish/report/plates.h"

namespace burnish {

/// The report as one HTML page that needs nothing but itself: pictures, histograms, tables, what
/// was done with which parameters in which time. Names and comments are escaped. The same record
/// and plates give the same bytes. Errors: out_of_memory, cancelled.
Result<std::string> html_report(const Record& record, const Plates& plates,
                                const Context& context = {});

/// Writes the page whole or not at all. Errors: those of html_report and of the file system.
Result<void> write_report(const std::filesystem::path& path, const Record& record,
                          const Plates& plates, const Context& context = {});

/// paint_plates and write_report in one.
Result<void> write_report(const std::filesystem::path& path, const Record& record,
                          const ReportOptions& options = {}, const Context& context = {});

/// Writes every picture as PREFIX-VIEW-PHASE.png and all of them in one as PREFIX-overview.png;
/// each whole or not at all. Returns the paths, the overview first; nothing where there are no
/// plates.
Result<std::vector<std::filesystem::path>> write_pictures(const std::filesystem::path& prefix,
                                                          const Record& record,
                                                          const Plates& plates,
                                                          const Context& context = {});

}  // namespace burnish
