#include "app/report/document.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/base/error.h"

namespace trisect::report {
namespace {

TEST(Document, IsMarkdownAndHtml) {
  const std::vector<Block> blocks{Heading{2, "A < B"}, Paragraph{"Text & more."},
                                  Items{{"one", "two"}}, Table{{{"a", "b"}, {"1", "2"}}}};
  EXPECT_EQ(markdown_of(blocks),
            "## A < B\n\nText & more.\n\n- one\n- two\n\n| a | b |\n|---|---|\n| 1 | 2 |\n");
  const std::string html = html_of("T", blocks, ".");
  EXPECT_NE(html.find("<h2>A &lt; B</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>2</td>"), std::string::npos);
  EXPECT_THROW(html_of("T", {Picture{"none.svg", ""}}, "."), InputError);
  // RFC 4648, section 10.
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace trisect::report
