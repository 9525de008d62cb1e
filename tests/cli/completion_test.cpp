// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::UnorderedElementsAre;

/// Exit code and output of a shell command in `directory`.
Outcome run_in_shell(const std::filesystem::path& directory, const std::string& command) {
  const std::string line = "cd '" + directory.string() + "' && " + command;
  std::FILE* const pipe = ::popen(line.c_str(), "r");  // NOLINT(cert-env33-c)
  if (pipe == nullptr) return {};
  Outcome outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    outcome.out.append(buffer.data(), count);
  }
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// Prints what the shell suggests for the line in LINE.
const char* program_of(const std::string& shell) {
  if (shell == "bash") {
    return R"(
source <("$FLAGSTONE" completion bash)
read -ra COMP_WORDS <<< "$LINE"
[[ $LINE != *' ' ]] || COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_flagstone
printf '%s\n' "${COMPREPLY[@]}"
)";
  }
  if (shell == "fish") {
    return R"(
$FLAGSTONE completion fish | source
complete -C "$LINE" | string split -f1 \t
)";
  }
  // zsh completes only in an interactive shell, so it runs in a pseudo-terminal.
  return R"(
zmodload zsh/zpty || exit 1
cat > setup <<'END'
autoload -Uz compinit
compinit -u -D
source <($FLAGSTONE completion zsh)
compadd() {
  if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
    builtin compadd "$@"
    return
  fi
  local -a hits
  builtin compadd -A hits "$@"
  print -rl -- $hits >> $STATE/hits
  builtin compadd "$@"
}
finish() { print > $STATE/done }
comppostfuncs=(finish)
bindkey '^I' complete-word
END
export STATE=$(mktemp -d)
mv setup $STATE
wait_for() { repeat 500; do [[ -e $STATE/$1 ]] && return; zpty -r -t inner output; sleep 0.02; done }
zpty inner zsh -f -i
zpty -w inner "source $STATE/setup; print > $STATE/ready"
wait_for ready
zpty -n -w inner "$LINE"$'\t'
wait_for done
zpty -d inner
[[ ! -e $STATE/hits ]] || sort -u $STATE/hits
rm -r $STATE
)";
}

/// A directory with a file and a directory, in which a shell completes command lines.
class Completion : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (run_in_shell("/", std::string("command -v ") + GetParam() + " > /dev/null").exit_code !=
        0) {
      GTEST_SKIP() << GetParam() << " is not installed";
    }
    std::ofstream(program_) << program_of(GetParam());
    std::filesystem::create_directory(files_ / "verge");
    std::ofstream(files_ / "velodyne.toml") << "";
  }

  [[nodiscard]] std::vector<std::string> completed(const std::string& line) const {
    const Outcome outcome = run_in_shell(
        files_.path(), "HOME=/nonexistent FLAGSTONE='" FLAGSTONE_COMMAND "' LINE='" + line + "' " +
                           GetParam() + (std::string(GetParam()) == "zsh" ? " -f '" : " '") +
                           program_.string() + "' 2> /dev/null");
    std::vector<std::string> words;
    for (std::string word : lines_of(outcome.out)) {
      if (word.ends_with('/')) word.pop_back();  // fish marks directories
      if (!word.empty()) words.push_back(word);
    }
    return words;
  }

 private:
  io::TemporaryFolder files_;
  io::TemporaryFolder programs_;
  std::filesystem::path program_ = programs_ / "program";
};

TEST_P(Completion, OfTheFirstWordIsTheCommands) {
  EXPECT_THAT(completed("flagstone se"), UnorderedElementsAre("segment", "sensors"));
}

TEST_P(Completion, OfAWordThatBeginsWithADashIsTheOptionsOfTheCommand) {
  EXPECT_THAT(completed("flagstone segment --me"), ElementsAre("--method"));
  EXPECT_THAT(completed("flagstone demo --me"), IsEmpty());
}

TEST_P(Completion, OfAMethodIsTheMethodsOfTheCommand) {
  EXPECT_THAT(completed("flagstone segment --method "), IsSupersetOf({"surface", "gpf"}));
  EXPECT_THAT(completed("flagstone bench --method "), UnorderedElementsAre("patchwork", "surface"));
}

TEST_P(Completion, OfNamesIsThoseThatTheOptionTakes) {
  EXPECT_THAT(completed("flagstone segment --preset "),
              UnorderedElementsAre("default", "paper", "reference"));
  EXPECT_THAT(completed("flagstone segment --format "),
              UnorderedElementsAre("label", "u8", "npy", "pcd", "ply", "split"));
  EXPECT_THAT(completed("flagstone simulate --scene steep"), ElementsAre("steep_street"));
  EXPECT_THAT(completed("flagstone eval --protocol patchwork+"), ElementsAre("patchwork++"));
  EXPECT_THAT(completed("flagstone segment --sensor-height "),
              UnorderedElementsAre("estimate", "track"));
  EXPECT_THAT(completed("flagstone completion "), UnorderedElementsAre("bash", "zsh", "fish"));
}

TEST_P(Completion, OfASensorIsItsNameOrAFile) {
  EXPECT_THAT(completed("flagstone segment --sensor v"), IsSupersetOf({"vlp-16", "velodyne.toml"}));
}

TEST_P(Completion, OfAnOutputDirectoryIsDirectories) {
  EXPECT_THAT(completed("flagstone segment --output ve"), ElementsAre("verge"));
}

TEST_P(Completion, OfAScanIsFilesAndDirectories) {
  EXPECT_THAT(completed("flagstone segment ve"), UnorderedElementsAre("velodyne.toml", "verge"));
}

TEST_P(Completion, OfANumberIsNothing) {
  EXPECT_THAT(completed("flagstone segment --threads "), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Shells, Completion, testing::Values("bash", "zsh", "fish"),
                         [](const auto& shell) { return std::string(shell.param); });

TEST(CompletionCommand, RejectsAnUnknownShell) {
  const Outcome outcome = run({"completion", "basch"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'bash'?"));
}

/// The words that the bash script suggests after `option` of `command`.
std::string suggested(const std::string& script, const std::string& command,
                      const std::string& option) {
  std::smatch match;
  const std::regex line("'" + command + " " + option + R"('\).*words='([^']*)')");
  return std::regex_search(script, match, line) ? match[1].str() : "";
}

/// So that a new option is not forgotten in src/cli/option_values.cpp.
TEST(CompletionCommand, SuggestsValuesForEveryOptionThatTakesAName) {
  const std::string script = run({"completion", "bash"}).out;
  int options = 0;
  for (const char* command :
       {"segment", "map", "bag", "ray", "doctor", "eval", "sweep", "bench", "simulate", "config"}) {
    const std::string help = run({command, "--help"}).out;
    const std::regex pattern(R"(\n  (--[a-z-]+) (NAME|KIND|FORMAT)\b(?!=))");
    for (std::sregex_iterator found(help.begin(), help.end(), pattern), end; found != end;
         ++found) {
      ++options;
      EXPECT_NE(suggested(script, command, (*found)[1]), "") << command << " " << (*found)[1];
    }
  }
  EXPECT_GT(options, 30);
}

}  // namespace
}  // namespace flagstone::cli
