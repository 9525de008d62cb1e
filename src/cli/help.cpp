// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <string_view>

#include "app/wrapped.hpp"

namespace flagstone::cli {
namespace {

constexpr std::size_t indent = 2;
constexpr std::size_t meaning_column = 29;
constexpr char hard_space = '\x1f';  // becomes a space after lines are wrapped

/// Between 80 and 100 columns on a terminal; 80 in files, so that the text is always the same.
std::size_t help_width() {
  constexpr std::size_t narrowest = 80;
  constexpr std::size_t widest = 100;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return narrowest;
  return std::clamp<std::size_t>(size.ws_col, narrowest, widest);
}

/// "(default: surface)", "(required)", or nothing.
std::string notes_of(const CLI::Option& option) {
  std::vector<std::string> notes;
  const bool is_argument = option.get_positional();
  if (option.get_required() && !is_argument) notes.emplace_back("required");
  if (takes_many(option) && !is_argument && option.get_delimiter() == '\0') {
    notes.emplace_back("repeatable");
  }
  if (!option.get_default_str().empty()) {
    notes.push_back(fmt::format("default:{}{}", hard_space, option.get_default_str()));
  }
  for (const CLI::Option* const needed : option.get_needs()) {
    notes.push_back(fmt::format("needs {}", needed->get_name()));
  }
  for (const CLI::Option* const excluded : option.get_excludes()) {
    notes.push_back(fmt::format("not with {}", excluded->get_name()));
  }
  return notes.empty() ? "" : fmt::format(" ({})", fmt::join(notes, "; "));
}

class CommandHelp final : public CLI::FormatterBase {
 public:
  explicit CommandHelp(Help help) : help_(std::move(help)) {}

  [[nodiscard]] const Help& help() const noexcept { return help_; }

  std::string make_help(const CLI::App* command, std::string name,
                        CLI::AppFormatMode /*mode*/) const override {
    const Page page;
    return page.paragraph(command->get_description()) +
           fmt::format("\nUsage: {} {}\n", name, usage_of(*command)) + examples(page) +
           arguments(*command, page) + commands(*command, page) + options(*command, page) +
           lists(page) + (help_.notes.empty() ? "" : "\n" + page.paragraph(help_.notes)) + "\n" +
           page.paragraph("Exit codes: " + help_.exit_codes);
  }

 private:
  struct Page {
    std::size_t width = help_width();

    [[nodiscard]] std::string paragraph(std::string_view text) const {
      return app::wrapped(text, {.width = width}) + "\n";
    }

    /// `name` and, from `column` on, its meaning.
    [[nodiscard]] std::string entry(std::string_view name, std::string_view meaning,
                                    std::size_t column, std::size_t name_column = indent) const {
      const std::size_t end = name_column + name.size();
      return fmt::format(
          "{:{}}{}{}{:{}}{}\n", "", name_column, name, end + 1 < column ? "" : "\n", "",
          end + 1 < column ? column - end : column,
          app::wrapped(meaning, {.column = column, .indent = column, .width = width}));
    }
  };

  /// Each meaning to the right of its command if all have room there, otherwise below it.
  [[nodiscard]] std::string examples(const Page& page) const {
    std::size_t column = 0;
    std::size_t widest = 0;
    for (const Example& example : help_.examples) {
      column = std::max(column, indent + example.command.size() + 2);
    }
    for (const Example& example : help_.examples) {
      widest = std::max(widest, column + example.meaning.size());
    }
    std::string text = "\nExamples:\n";
    for (const auto& [command, meaning] : help_.examples) {
      if (meaning.empty()) {
        text += fmt::format("{:{}}{}\n", "", indent, command);
      } else if (widest <= page.width) {
        text += page.entry(command, meaning, column);
      } else {
        text += fmt::format("{:{}}{}\n{:{}}{}\n", "", indent, command, "", 3 * indent, meaning);
      }
    }
    return text;
  }

  static std::string arguments(const CLI::App& command, const Page& page) {
    std::string text;
    for (const CLI::Option* const option : command.get_options()) {
      if (option->get_positional()) text += option_entry(*option, page);
    }
    return text.empty() ? text : "\nArguments:\n" + text;
  }

  /// By group, in the order in which they were added.
  static std::string commands(const CLI::App& program, const Page& page) {
    constexpr std::size_t column = 14;
    std::string text;
    std::string group;
    for (const CLI::App* const command : program.get_subcommands({})) {
      if (command->get_group() != group) text += fmt::format("\n{}:\n", command->get_group());
      group = command->get_group();
      text += page.entry(command->get_name(), command->get_description(), column);
    }
    return text;
  }

  static std::string options(const CLI::App& command, const Page& page) {
    std::string text;
    for (const OptionGroup& group : option_groups(command)) {
      text += fmt::format("\n{}:\n", group.name);
      for (const CLI::Option* const option : group.options) text += option_entry(*option, page);
    }
    return text;
  }

  static std::string option_entry(const CLI::Option& option, const Page& page) {
    const auto [meaning, names] = text_of(option);
    std::string text = page.entry(label_of(option), meaning, meaning_column);
    std::ranges::replace(text, hard_space, ' ');
    std::size_t widest = 0;
    for (const auto& [name, value] : names) widest = std::max(widest, name.size());
    for (const auto& [name, value] : names) {
      text += page.entry(name, value, meaning_column + widest + 2, meaning_column);
    }
    return text;
  }

  [[nodiscard]] std::string lists(const Page& page) const {
    std::string text;
    for (const NameList& list : help_.lists) {
      std::size_t column = 0;
      for (const auto& [name, meaning] : list.names) {
        column = std::max(column, indent + name.size() + 2);
      }
      text += fmt::format("\n{}:\n", list.title);
      for (const auto& [name, meaning] : list.names) text += page.entry(name, meaning, column);
    }
    return text;
  }

  Help help_;
};

}  // namespace

void set_help(CLI::App& command, Help help) {
  command.set_help_flag("-h,--help", "Show this help")->group(other_group);
  command.formatter(std::make_shared<CommandHelp>(std::move(help)));
}

const Help& help_of(const CLI::App& command) {
  return dynamic_cast<const CommandHelp&>(*command.get_formatter()).help();
}

std::string label_of(const CLI::Option& option) {
  if (option.get_positional()) return option.get_type_name() + (takes_many(option) ? "..." : "");
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  std::string label = fmt::format("{}", fmt::join(names, ", "));
  if (option.get_items_expected_max() > 0) label += " " + option.get_type_name();
  return label;
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

OptionText text_of(const CLI::Option& option) {
  const std::string& description = option.get_description();
  std::string_view rest = description;
  const auto next_line = [&rest] {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    return line;
  };
  OptionText text{.meaning = std::string(next_line()) + notes_of(option)};
  while (!rest.empty()) {
    const std::string_view line = next_line();
    const std::size_t tab = line.find('\t');
    text.names.emplace_back(line.substr(0, tab), line.substr(tab + 1));
  }
  return text;
}

std::vector<OptionGroup> option_groups(const CLI::App& command) {
  // Input comes first, then the groups of the command in their order, then output and other.
  constexpr int group_ranks = 4;
  const auto rank_of = [](const std::string& name) {
    return name == input_group ? 0 : name == output_group ? 2 : name == other_group ? 3 : 1;
  };
  std::vector<OptionGroup> groups;
  for (int rank = 0; rank < group_ranks; ++rank) {
    for (const std::string& name : command.get_groups()) {
      if (rank_of(name) != rank) continue;
      OptionGroup group{.name = name};
      for (const CLI::Option* const option : command.get_options()) {
        if (option->get_positional() || option->get_group() != name) continue;
        if (option != command.get_help_ptr()) group.options.push_back(option);
      }
      const CLI::Option* const help = command.get_help_ptr();
      if (help != nullptr && help->get_group() == name) group.options.push_back(help);
      if (!group.options.empty()) groups.push_back(std::move(group));
    }
  }
  return groups;
}

std::string usage_of(const CLI::App& command) {
  if (!command.get_subcommands({}).empty()) return "COMMAND [OPTIONS] ...";
  std::string text = "[OPTIONS]";
  for (const CLI::Option* const option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string label = label_of(*option);
    text += option->get_required() ? " " + label : " [" + label + "]";
  }
  return text;
}

}  // namespace flagstone::cli
