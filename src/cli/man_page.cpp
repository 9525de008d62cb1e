// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/man_page.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/help.hpp"
#include "flagstone/version.hpp"

namespace flagstone::cli {
namespace {

/// Text for roff, in which "-" is a hyphen, quotes are typographic and a dot begins a request.
std::string roff(std::string_view text) {
  std::string result;
  if (text.starts_with('.') || text.starts_with('\'')) result = "\\&";
  for (const char c : text) {
    switch (c) {
      case '\\': result += "\\e"; break;
      case '-': result += "\\-"; break;
      case '\'': result += "\\(aq"; break;
      case '`': result += "\\(ga"; break;
      case '^': result += "\\(ha"; break;
      case '~': result += "\\(ti"; break;
      case '\x1f': result += "\\ "; break;  // a space of the help at which no line ends
      default: result += c;
    }
  }
  return result;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

std::string upper_case(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string section(std::string_view name) {
  return fmt::format(".SH {}\n", roff(upper_case(std::string(name))));
}

/// A paragraph with a label to its left. An empty line in roff would be an error.
std::string entry(const std::string& label, std::string_view meaning) {
  return fmt::format(".TP\n{}\n{}\n", label, meaning.empty() ? "\\&" : roff(meaning));
}

std::string label(const CLI::Option& option) {
  if (option.get_positional()) return italic(label_of(option));
  std::string text;
  for (const std::string& name : option.get_snames()) {
    text += (text.empty() ? "" : ", ") + bold("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    text += (text.empty() ? "" : ", ") + bold("--" + name);
  }
  if (option.get_items_expected_max() > 0) text += " " + italic(option.get_type_name());
  return text;
}

std::string option_entry(const CLI::Option& option) {
  const auto [meaning, names] = text_of(option);
  std::string text = entry(label(option), meaning);
  if (names.empty()) return text;
  text += ".RS\n";
  for (const auto& [name, value] : names) text += entry(bold(name), value);
  return text + ".RE\n";
}

std::string options(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_positional()) text += option_entry(*option);
  }
  if (!text.empty()) text = section("Arguments") + text;
  text += section("Options");
  for (const OptionGroup& group : option_groups(command)) {
    text += fmt::format(".SS {}\n", roff(group.name));
    for (const CLI::Option* const option : group.options) text += option_entry(*option);
  }
  return text;
}

std::string commands(const CLI::App& program) {
  std::string text;
  std::string group;
  for (const CLI::App* const command : program.get_subcommands({})) {
    if (command->get_group() != group) text += fmt::format(".SS {}\n", roff(command->get_group()));
    group = command->get_group();
    text += entry(fmt::format("{}(1)", bold("flagstone-" + command->get_name())),
                  command->get_description());
  }
  return text.empty() ? text : section("Commands") + text;
}

std::string examples(const Help& help) {
  std::string text = section("Examples");
  for (const Example& example : help.examples) {
    text += entry(bold(example.command), example.meaning);
  }
  return text;
}

/// "0, success; 2, usage error." as a list.
std::string exit_status(std::string_view codes) {
  std::string text = section("Exit status");
  if (codes.ends_with('.')) codes.remove_suffix(1);
  while (!codes.empty()) {
    const std::string_view code = codes.substr(0, codes.find("; "));
    const std::size_t comma = code.find(", ");
    text += entry(bold(code.substr(0, comma)), code.substr(comma + 2));
    codes.remove_prefix(std::min(code.size() + 2, codes.size()));
  }
  return text;
}

std::string see_also(const CLI::App& command) {
  std::vector<std::string> names;
  const CLI::App* const program = command.get_parent();
  if (program == nullptr) {
    for (const CLI::App* const other : command.get_subcommands({})) {
      names.push_back("flagstone-" + other->get_name());
    }
  } else {
    names.emplace_back("flagstone");
    for (const CLI::App* const other : program->get_subcommands({})) {
      if (other != &command && other->get_group() == command.get_group()) {
        names.push_back("flagstone-" + other->get_name());
      }
    }
  }
  std::string text = section("See also");
  for (const std::string& name : names) {
    text += fmt::format(".BR {} (1){}\n", roff(name), &name == &names.back() ? "" : ",");
  }
  return text;
}

}  // namespace

std::string man_page(const CLI::App& command) {
  const Help& help = help_of(command);
  const bool is_program = command.get_parent() == nullptr;
  const std::string program = is_program ? "" : "flagstone ";
  std::string name = is_program ? "flagstone" : "flagstone-" + command.get_name();
  const std::string& description = command.get_description();
  std::string summary = description.substr(0, description.find_last_not_of('.') + 1);

  // Names of files and options must not be hyphenated, and lines with them not be stretched.
  std::string text = fmt::format(".TH {} 1 \"\" \"flagstone {}\" \"User Commands\"\n.nh\n.ad l\n",
                                 roff(upper_case(name)), FLAGSTONE_VERSION);
  text += section("Name") + fmt::format("{} \\- {}\n", roff(name), roff(summary));
  text += section("Synopsis") +
          fmt::format("{} {}\n", bold(program + command.get_name()), italic(usage_of(command)));
  text += section("Description") + roff(description) + "\n";
  if (!help.notes.empty()) text += ".PP\n" + roff(help.notes) + "\n";
  text += commands(command) + options(command);
  for (const NameList& list : help.lists) {
    text += section(list.title);
    for (const auto& [known, meaning] : list.names) text += entry(bold(known), meaning);
  }
  return text + exit_status(help.exit_codes) + examples(help) + see_also(command);
}

}  // namespace flagstone::cli
