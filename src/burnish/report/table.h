#pragma once

#include <string>
#include <utility>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/report/html.h"

namespace burnish {

/// A table of numbers: one column per phase (or whatever is compared), one row per quantity.
struct Table {
  struct Row {
    std::string title;
    std::vector<std::string> cells;  ///< one per column
    std::vector<bool> wrong;         ///< cells to point out; may be empty
  };
  std::string caption;
  std::vector<std::string> columns;
  std::vector<Row> rows;
};

/// Rows for all keys of `facts` (one entry per column) in the order in which they first appear;
/// a row has one unit, that of its largest value, so that its cells can be compared.
std::vector<Table::Row> rows_of(const std::vector<Facts>& facts);

/// With a caption, and headers for columns and rows.
void write_table(HtmlWriter& html, const Table& table);

}  // namespace burnish
