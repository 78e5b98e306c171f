#include "burnish/report/html.h"

#include <gtest/gtest.h>

#include "report/well_formed.h"

namespace burnish {
namespace {

TEST(EscapeHtml, TurnsMarkupIntoText) {
  EXPECT_EQ(escape_html("<script>alert('x') && \"y\"</script>"),
            "&lt;script&gt;alert(&#39;x&#39;) &amp;&amp; &quot;y&quot;&lt;/script&gt;");
}

TEST(EscapeHtml, KeepsUtf8AndLineEnds) {
  const std::string text = "Çınar, 45\u202f°, 表面 😀\n\ttab";
  EXPECT_EQ(escape_html(text), text);
}

TEST(EscapeHtml, ReplacesEveryByteThatIsNoUtf8) {
  const std::string r = "\uFFFD";
  EXPECT_EQ(escape_html("a\xff"
                        "b"),
            "a" + r + "b");
  EXPECT_EQ(escape_html("cut \xc3"), "cut " + r);
  EXPECT_EQ(escape_html("\xc0\xaf"), r + r) << "overlong";
  EXPECT_EQ(escape_html("\xe0\x80\xaf"), r + r + r) << "overlong";
  EXPECT_EQ(escape_html("\xed\xa0\x80"), r + r + r) << "surrogate";
  EXPECT_EQ(escape_html("\xf4\x90\x80\x80"), r + r + r + r) << "above U+10FFFF";
  EXPECT_EQ(escape_html("\xe2\x82<b>"), r + r + "&lt;b&gt;") << "a cut character hides no tag";
}

TEST(EscapeHtml, ReplacesControlCharacters) {
  const std::string r = "\uFFFD";
  EXPECT_EQ(escape_html(std::string_view("a\0b\x1b[2J\x7f", 8)), "a" + r + "b" + r + "[2J" + r);
  EXPECT_EQ(escape_html("\u0085"), r);
}

// The examples of RFC 4648, section 10.
TEST(Base64, EncodesAllLengths) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(HtmlWriter, ClosesWhatIsOpenAndEscapesAttributes) {
  HtmlWriter html;
  html.verbatim("<!DOCTYPE html>").open("p", {{"title", "\"><script>"}}).element("b", "1 < 2");
  const std::string page = html.finish();
  EXPECT_EQ(page, "<!DOCTYPE html><p title=\"&quot;&gt;&lt;script&gt;\"><b>1 &lt; 2</b></p>\n");
  EXPECT_EQ(test::malformed(page), "");
}

TEST(WellFormed, FindsWhatIsWrong) {
  EXPECT_EQ(test::malformed("<!DOCTYPE html><p><b>x</b></p>"), "");
  EXPECT_NE(test::malformed("<!DOCTYPE html><p><b>x</p></b>"), "");
  EXPECT_NE(test::malformed("<!DOCTYPE html><p>x"), "");
  EXPECT_NE(test::malformed("<!DOCTYPE html><p>a & b</p>"), "");
  EXPECT_NE(test::malformed("<!DOCTYPE html><p>a < b</p>"), "");
}

}  // namespace
}  // namespace burnish
