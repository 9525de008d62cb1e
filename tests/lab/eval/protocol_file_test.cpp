// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/protocol_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "files/io/temporary_folder.hpp"

namespace flagstone::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ProtocolFile : public testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& text) {
    const auto path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }

  std::string complaint(const std::string& name, const std::string& text) {
    Protocol protocol;
    const Status status = read_protocol(put(name, text), protocol);
    EXPECT_FALSE(status.ok()) << text;
    EXPECT_THAT(status.message(), AllOf(HasSubstr(name), Not(HasSubstr("\n"))));
    return status.message();
  }

  io::TemporaryFolder folder_;
};

TEST_F(ProtocolFile, JsonAndTomlSayTheSame) {
  Protocol json;
  Protocol toml;
  ASSERT_TRUE(read_protocol(put("mine.json", R"({"ground": [40, 48], "ignored": [0],
      "not_ground": [10, 70], "low_ground": [{"id": 70, "height": -1.5}], "note": "text"})"),
                            json)
                  .ok());
  ASSERT_TRUE(read_protocol(put("mine.toml",
                                "ground = [40, 48]\nignored = [0]\nnot_ground = [10]\n"
                                "low_ground = [{id = 70, height = -1.5}]\n"),
                            toml)
                  .ok());

  for (const Protocol& protocol : {json, toml}) {
    EXPECT_EQ(protocol.name, "mine");
    EXPECT_THAT(protocol.ground, ElementsAre(40, 48));
    EXPECT_THAT(protocol.ignored, ElementsAre(0));
    ASSERT_EQ(protocol.low_ground.size(), 1u);
    EXPECT_EQ(protocol.low_ground[0].id, 70u);
    EXPECT_EQ(protocol.low_ground[0].height, -1.5f);
  }
}

TEST_F(ProtocolFile, ANameOfItsOwnCounts) {
  Protocol protocol;
  ASSERT_TRUE(read_protocol(put("a.toml", "name = \"terrain\"\nground = [2]\n"), protocol).ok());

  EXPECT_EQ(protocol.name, "terrain");
  EXPECT_THAT(protocol.ignored, IsEmpty());
}

TEST_F(ProtocolFile, WhatIsWrongIsSaidInOneLineWithTheKey) {
  EXPECT_THAT(complaint("a.json", "{"), HasSubstr("byte"));
  EXPECT_THAT(complaint("a.toml", "ground = "), HasSubstr("line 1"));
  EXPECT_THAT(complaint("a.json", "[]"), HasSubstr("ground"));
  EXPECT_THAT(complaint("a.json", "{}"), HasSubstr("ground"));
  EXPECT_THAT(complaint("a.json", R"({"ground": 3})"), HasSubstr("ground"));
  EXPECT_THAT(complaint("a.json", R"({"ground": [-1]})"), HasSubstr("0 to 65535"));
  EXPECT_THAT(complaint("a.json", R"({"ground": [1, 70000]})"), HasSubstr("70000"));
  EXPECT_THAT(complaint("a.json", R"({"ground": [1e999]})"), HasSubstr("beyond"));
  EXPECT_THAT(complaint("a.json", R"({"ground": [1], "ignored": [1]})"), HasSubstr("class 1"));
  EXPECT_THAT(complaint("a.json", R"({"ground": [1], "low_ground": [{"id": 2}]})"),
              HasSubstr("height"));
  EXPECT_THAT(complaint("a.yaml", "ground: [1]"), HasSubstr(".toml or .json"));
}

TEST_F(ProtocolFile, AProtocolIsFoundByNameOrByFile) {
  Protocol protocol;
  EXPECT_TRUE(find_protocol("patchwork++", protocol).ok());
  EXPECT_EQ(protocol.name, "patchwork++");
  EXPECT_TRUE(find_protocol(put("own.json", R"({"ground": [7]})").string(), protocol).ok());
  EXPECT_EQ(protocol.name, "own");

  const Status status = find_protocol("semantickitti", protocol);
  EXPECT_THAT(status.message(), AllOf(HasSubstr("semantickitti"), HasSubstr("lidarseg")));
}

}  // namespace
}  // namespace flagstone::eval
