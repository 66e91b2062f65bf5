#include "scene/obj_lines.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace facemap {
namespace {

using Lines = std::vector<std::pair<std::int64_t, std::string>>;

Lines cut(std::string_view text) {
  Lines found;
  for (ObjLines lines(text); lines.next();) {
    const std::string_view line(lines.begin());
    found.emplace_back(lines.number(), line.substr(0, line.find('\n')));
  }
  return found;
}

TEST(ObjLines, CountsLinesFromOne) { EXPECT_EQ(cut("a\n\nb\n"), (Lines{{1, "a"}, {2, ""}, {3, "b"}})); }

TEST(ObjLines, HasNoneInAnEmptyText) {
  EXPECT_EQ(cut(""), Lines{});
  EXPECT_EQ(cut("\xEF\xBB\xBF"), Lines{});
}

TEST(ObjLines, TakesALastLineWithoutNewline) { EXPECT_EQ(cut("a\nb"), (Lines{{1, "a"}, {2, "b"}})); }

TEST(ObjLines, SkipsAByteOrderMark) { EXPECT_EQ(cut("\xEF\xBB\xBFv 1\n"), (Lines{{1, "v 1"}})); }

TEST(ObjLines, JoinsContinuedLines) {
  EXPECT_EQ(cut("f 1 \\\n2 \\\n3\nv\n"), (Lines{{1, "f 1  2  3"}, {4, "v"}}));
  EXPECT_EQ(cut("f 1\\\r\n2\r\nv"), (Lines{{1, "f 1 2"}, {3, "v"}}));
  EXPECT_EQ(cut("\\\n\\\nv\n"), (Lines{{1, "  v"}}));
}

TEST(ObjLines, ContinuesNothingAtTheEnd) {
  EXPECT_EQ(cut("a\\"), (Lines{{1, "a"}}));
  EXPECT_EQ(cut("a\\\n"), (Lines{{1, "a"}}));
  EXPECT_EQ(cut("a \\\n\\"), (Lines{{1, "a  "}}));
}

TEST(ObjLines, DoesNotContinueComments) { EXPECT_EQ(cut("  # C:\\\nv 1\n"), (Lines{{1, "  # C:"}, {2, "v 1"}})); }

TEST(ObjLines, LeavesBackslashesInsideALine) { EXPECT_EQ(cut("a\\b\n"), (Lines{{1, "a\\b"}})); }

TEST(RestOfLine, IsWithoutBlanksAtItsEnds) {
  EXPECT_EQ(rest_of_line(" \ta b \t\r\n"), "a b");
  EXPECT_EQ(rest_of_line("  \n"), "");
}

TEST(Printable, KeepsUtf8AndReplacesTheRest) {
  EXPECT_EQ(printable("na\xC3\xAFve \xE2\x82\xAC \xF0\x9F\x98\x80"), "na\xC3\xAFve \xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(printable("a\x1B[31m\x7F"), "a?[31m?");
  EXPECT_EQ(printable("\xC2\x9B"), "??");  // a control code of two bytes
  EXPECT_EQ(printable("\xE4"
                      "bc"),
            "?bc");                                       // Latin-1
  EXPECT_EQ(printable("\xC0\x80\xED\xA0\x80"), "?????");  // overlong; a surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "????");       // past U+10FFFF
  EXPECT_EQ(printable("\xE2\x82"), "??");                 // cut short
}

TEST(Printable, CutsLongText) {
  EXPECT_EQ(printable(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(printable(std::string(61, 'x')), std::string(60, 'x') + "...");
}

}  // namespace
}  // namespace facemap
