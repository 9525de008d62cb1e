// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace flagstone::cli {

/// @name Groups of options, for Option::group(). Help lists Input first, Output and Other last.
/// @{
inline constexpr const char* input_group = "Input";
inline constexpr const char* method_group = "Method and settings";
inline constexpr const char* output_group = "Output";
inline constexpr const char* other_group = "Other";
/// @}

struct Example {
  std::string command;
  std::string meaning{};
};

/// Names and their meanings, such as the scenes of the simulator.
struct NameList {
  std::string title;
  std::vector<std::pair<std::string, std::string>> names{};
};

/// The parts of a help text that CLI11 does not have. The rest is made from the description of the
/// command and from its options.
struct Help {
  std::vector<Example> examples;
  std::vector<NameList> lists{};
  std::string notes{};
  std::string exit_codes = "0, success; 1, some inputs failed; 2, usage error.";
};

/// Gives a command its help text: description, usage, examples, arguments, options by group.
///
/// Options are printed as they are declared: defaults (`default_str`), `required`, `needs` and
/// repeatable options are noted in parentheses after the description. A description may continue
/// with lines of the form "\nNAME\tMEANING", which are printed as a table.
void set_help(CLI::App& command, Help help);

/// What set_help() gave to a command.
const Help& help_of(const CLI::App& command);

/// "SCAN..." for an argument, "-o, --output DIR" for an option.
std::string label_of(const CLI::Option& option);

/// Whether an argument or option takes any number of values.
bool takes_many(const CLI::Option& option);

/// What an option means, with its notes in parentheses, and the table of names that its description
/// may have.
struct OptionText {
  std::string meaning;
  std::vector<std::pair<std::string, std::string>> names{};
};
OptionText text_of(const CLI::Option& option);

struct OptionGroup {
  std::string name;
  std::vector<const CLI::Option*> options{};
};

/// The options of a command by group, in the order of its help.
std::vector<OptionGroup> option_groups(const CLI::App& command);

/// The words after the name of a command: "[OPTIONS] SCAN...".
std::string usage_of(const CLI::App& command);

}  // namespace flagstone::cli
