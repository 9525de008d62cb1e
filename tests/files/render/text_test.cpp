// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/render/picture.hpp"

namespace flagstone::render {
namespace {

using testing::EndsWith;
using testing::StartsWith;

TEST(PrintableText, KeepsUtf8) {
  for (const char* text :
       {"", "scan.bin", "Stra\u00dfe \u20ac \U0001F6B2", "\u07ff\uffff\U0010ffff"})
    EXPECT_EQ(printable(text), text);
}

TEST(PrintableText, ReplacesControlCharacters) { EXPECT_EQ(printable("a\nb\tc\x7f"), "a?b?c?"); }

TEST(PrintableText, ReplacesEveryByteThatIsNotUtf8) {
  EXPECT_EQ(printable("a\x80z"), "a?z");             // not a first byte
  EXPECT_EQ(printable("\xc3"), "?");                 // truncated
  EXPECT_EQ(printable("\xe2\x82z"), "??z");          // truncated
  EXPECT_EQ(printable("\xc0\xaf"), "??");            // overlong
  EXPECT_EQ(printable("\xe0\x80\xaf"), "???");       // overlong
  EXPECT_EQ(printable("\xf0\x80\x80\xaf"), "????");  // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // above U+10FFFF
  EXPECT_EQ(printable("\xff"), "?");
}

TEST(Text, UsesOnlyAsciiWithoutFonts) {
  const auto is_ascii_without_fonts = [] {
    const io::TemporaryFolder folder;
    io::put_file(folder / "no-fonts.conf", "<fontconfig/>");
    ::setenv("FONTCONFIG_FILE", (folder / "no-fonts.conf").c_str(), 1);
    const Canvas canvas(100, 100);
    const Font font{.size = 20, .bold = false, .color = text_color};
    const auto width = [&](const char* text) { return text_width(canvas.context(), text, font); };
    return width("\u22121.5") == width("-1.5") && width("a\u2026") == width("a...");
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // fonts are loaded once per process
  EXPECT_EXIT(std::_Exit(is_ascii_without_fonts() ? 0 : 1), testing::ExitedWithCode(0), "");
}

class FittedText : public testing::Test {
 protected:
  Canvas canvas_{100, 100};
  Font font_{.size = 20, .bold = false, .color = text_color};

  std::string fit(const std::string& text, double width) {
    const std::string fitted_text = fitted(canvas_.context(), text, font_, width);
    EXPECT_LE(text_width(canvas_.context(), fitted_text, font_), width);
    return fitted_text;
  }
};

TEST_F(FittedText, IsUnchangedIfItFits) { EXPECT_EQ(fit("scan.bin", 500), "scan.bin"); }

TEST_F(FittedText, KeepsStartAndEnd) {
  const std::string text = fit("a_very_long_name_of_a_folder/and_of_a_scan_000123.bin", 200);

  EXPECT_THAT(text, StartsWith("a_very"));
  EXPECT_THAT(text, EndsWith("123.bin"));
  EXPECT_THAT(text, testing::HasSubstr("\u2026"));
}

TEST_F(FittedText, IsNotCutWithinACharacter) {
  for (int width = 25; width < 200; ++width) {
    std::string umlauts;
    for (int i = 0; i < 40; ++i) umlauts += "\u00e4";
    const std::string text = fit(umlauts, width);
    EXPECT_EQ(text, printable(text));
  }
}

class BirdsEyeHeading : public PictureTest {
 protected:
  // Number of pixels above the panel that are not blank, and of these in the right margin.
  std::pair<std::size_t, std::size_t> ink(const std::string& title) {
    options_.title = title;
    const Picture picture = draw({});
    const Rectangle all{0, 0, picture.width() * 1.0, panel().y};
    const Rectangle margin{panel().right(), 0, picture.width() - panel().right(), panel().y};
    const auto area = [](const Rectangle& part) {
      return static_cast<std::size_t>(part.width * part.height);
    };
    return {area(all) - picture.count(all, page_color),
            area(margin) - picture.count(margin, page_color)};
  }
};

TEST_F(BirdsEyeHeading, ShowsItsTitle) {
  EXPECT_EQ(ink("").first, 0);
  EXPECT_GT(ink("scan.bin").first, 200);
}

TEST_F(BirdsEyeHeading, KeepsALongTitleOutOfTheMargin) {
  const auto [all, in_margin] = ink(std::string(10000, 'W'));

  EXPECT_GT(all, 200);
  EXPECT_EQ(in_margin, 0);
}

TEST_F(BirdsEyeHeading, AcceptsAnyBytesAsTitle) {
  EXPECT_GT(ink(std::string("\xff\xfe\n\0 name", 9)).first, 50);
}

}  // namespace
}  // namespace flagstone::render
