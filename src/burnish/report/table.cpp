#include "burnish/report/table.h"

#include <algorithm>
#include <cmath>

#include "burnish/report/numbers.h"

namespace burnish {
namespace {

const Fact* find(const Facts& facts, const std::string& key) {
  const auto at =
      std::find_if(facts.begin(), facts.end(), [&](const Fact& fact) { return fact.key == key; });
  return at == facts.end() ? nullptr : &*at;
}

Table::Row row_of(const std::vector<Facts>& facts, const Fact& first) {
  double largest = 0;
  for (const Facts& column : facts) {
    const Fact* fact = find(column, first.key);
    if (fact && std::isfinite(fact->value)) largest = std::max(largest, std::abs(fact->value));
  }
  const DisplayUnit unit = display_unit(first.unit, largest);
  Table::Row row{words_of(first.key), {}, {}};
  if (!unit.name.empty()) row.title += ", " + std::string(unit.name);
  std::vector<double> values;
  for (const Facts& column : facts) {
    if (const Fact* fact = find(column, first.key)) values.push_back(fact->value * unit.factor);
  }
  const std::vector<std::string> texts = row_texts(values);
  auto text = texts.begin();
  for (const Facts& column : facts) row.cells.push_back(find(column, first.key) ? *text++ : "");
  return row;
}

}  // namespace

std::vector<Table::Row> rows_of(const std::vector<Facts>& facts) {
  std::vector<Table::Row> rows;
  std::vector<std::string> seen;
  for (const Facts& column : facts) {
    for (const Fact& fact : column) {
      if (std::find(seen.begin(), seen.end(), fact.key) != seen.end()) continue;
      seen.push_back(fact.key);
      rows.push_back(row_of(facts, fact));
    }
  }
  return rows;
}

void write_table(HtmlWriter& html, const Table& table) {
  html.open("div", {{"class", "scroll"}}).open("table", {{"class", "numbers"}});
  html.element("caption", table.caption);
  html.open("thead").open("tr").element("td", "");
  for (const std::string& column : table.columns) html.element("th", column, {{"scope", "col"}});
  html.close().close().open("tbody");
  for (const Table::Row& row : table.rows) {
    html.open("tr").element("th", row.title, {{"scope", "row"}});
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const bool wrong = i < row.wrong.size() && row.wrong[i];
      html.element("td", row.cells[i], {{"class", wrong ? "wrong" : "number"}});
    }
    html.close();
  }
  html.close().close().close();
}

}  // namespace burnish
