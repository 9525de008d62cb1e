// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/peer_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace flagstone::bench {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// What `work` throws as PeerError says.
template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const PeerError& error) {
    return error.what();
  }
  return "no error";
}

TEST(PeerProcess, AnswersLinesOneByOne) {
  PeerProcess peer({"sh", "-c", "while read word number; do echo $number $word; done"});

  peer.send_line("run 3");
  peer.send_line("scan 40");

  EXPECT_EQ(peer.read_line(60s), "3 run");
  EXPECT_EQ(peer.read_line(60s), "40 scan");
}

TEST(PeerProcess, RunsOnOneThread) {
  PeerProcess peer({"sh", "-c", "echo $OMP_NUM_THREADS"});

  EXPECT_EQ(peer.read_line(60s), "1");
}

TEST(PeerProcess, ThatDoesNotExistIsNamed) {
  EXPECT_THAT(error_of([] { PeerProcess peer({"no-such-program"}); }),
              HasSubstr("no-such-program cannot be started: No such file"));
}

TEST(PeerProcess, ThatEndsIsAnErrorForReaderAndWriter) {
  PeerProcess peer({"true"});

  EXPECT_EQ(error_of([&] { peer.read_line(60s); }), "its worker ended too early");
  EXPECT_EQ(error_of([&] { peer.send_line("run 1"); }), "its worker ended too early");
}

TEST(PeerProcess, ThatSaysNothingIsNotWaitedForForever) {
  PeerProcess peer({"sleep", "600"});

  EXPECT_EQ(error_of([&] { peer.read_line(1s); }), "its worker said nothing for 1 s");
}

TEST(PeerProcess, ThatNeverEndsItsLineIsAnError) {
  PeerProcess peer({"sh", "-c", "while :; do printf 0123456789; done"});

  EXPECT_EQ(error_of([&] { peer.read_line(60s); }), "its worker talks without end");
}

}  // namespace
}  // namespace flagstone::bench
