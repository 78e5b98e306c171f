#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace burnish::test {

/// What is wrong with the tags of an HTML page; empty: every tag is closed in order, attributes are
/// quoted, and no bare < or & stands in the text.
inline std::string malformed(std::string_view html) {
  std::vector<std::string> open;
  constexpr std::string_view kDoctype = "<!DOCTYPE html>";
  if (!html.starts_with(kDoctype)) return "no doctype";
  std::size_t at = kDoctype.size();
  const auto place = [&] { return std::string(html.substr(at, 60)); };
  while (at < html.size()) {
    if (html[at] == '&') {
      const std::size_t end = html.find(';', at);
      if (end == std::string_view::npos || end - at > 7) return "bare ampersand: " + place();
      at = end + 1;
    } else if (html[at] != '<') {
      ++at;
    } else {
      // A tag ends at the first > outside quotes.
      std::size_t end = at + 1;
      bool quoted = false;
      while (end < html.size() && (quoted || html[end] != '>')) quoted ^= html[end++] == '"';
      if (end == html.size()) return "tag without an end: " + place();
      const std::string_view tag = html.substr(at + 1, end - at - 1);
      if (tag.find('<') != std::string_view::npos) return "tag within a tag: " + place();
      const bool closing = tag.starts_with('/');
      const std::string name(tag.substr(closing, tag.find_first_of(" \n", 1) - closing));
      if (name.empty() || !std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
          })) {
        return "no name of a tag: " + place();
      }
      at = end + 1;
      if (closing) {
        if (open.empty() || open.back() != name) return "closed out of order: " + name;
        open.pop_back();
      } else if (name == "style" || name == "script") {
        at = html.find("</" + name + ">", at);
        if (at == std::string_view::npos) return "never closed: " + name;
        at += name.size() + 3;
      } else if (name != "meta" && name != "img") {
        open.push_back(name);
      }
    }
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

}  // namespace burnish::test
