#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace burnish {

/// `text` as it may stand in HTML between tags and in quoted attributes: & < > " ' become entities,
/// bytes that are no UTF-8 and control characters become U+FFFD, so that names and comments from
/// files can neither break nor change a page. Line ends and tabs stay.
std::string escape_html(std::string_view text);

std::string base64(std::string_view bytes);

/// Writes HTML whose tags are balanced and whose text is escaped.
class HtmlWriter {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  /// <tag ...>, to be closed by close().
  HtmlWriter& open(std::string_view tag, Attributes attributes = {});
  HtmlWriter& close();
  /// <tag ...> that has no content: meta, img, br.
  HtmlWriter& empty(std::string_view tag, Attributes attributes = {});
  HtmlWriter& text(std::string_view text);
  /// open, text, close.
  HtmlWriter& element(std::string_view tag, std::string_view text, Attributes attributes = {});
  /// As it is: for style sheets and scripts, never for what comes from outside.
  HtmlWriter& verbatim(std::string_view html);

  /// The document; closes what is open.
  std::string finish();

 private:
  void tag(std::string_view name, Attributes attributes);

  std::string html_;
  std::vector<std::string> open_;
};

}  // namespace burnish
