// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/completion_scripts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <string_view>
#include <vector>

#include "cli/help.hpp"
#include "cli/option_values.hpp"

namespace flagstone::cli {
namespace {

using Paths = OptionValues::Paths;

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> options;
  for (const OptionGroup& group : option_groups(command)) {
    options.insert(options.end(), group.options.begin(), group.options.end());
  }
  return options;
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& command) {
  std::vector<const CLI::Option*> arguments;
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_positional()) arguments.push_back(option);
  }
  return arguments;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// "-o" and "--output".
std::vector<std::string> words_of(const CLI::Option& option) {
  std::vector<std::string> words;
  for (const std::string& name : option.get_snames()) words.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.push_back("--" + name);
  return words;
}

/// The first part of the meaning of an option: a line in a menu has no room for more.
std::string summary_of(const CLI::Option& option) {
  const std::string& text = option.get_description();
  return text.substr(0, text.find_first_of(":;\n"));
}

/// `text` with a backslash before each of `specials`.
std::string escaped(std::string_view text, std::string_view specials) {
  std::string result;
  for (const char c : text) {
    if (specials.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// A word in single quotes for bash and zsh.
std::string single_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

/// A word in single quotes for fish.
std::string fish_quoted(std::string_view text) { return "'" + escaped(text, "\\'") + "'"; }

/// What bash suggests: variables of the script.
std::string bash_values(const OptionValues& values) {
  std::string text;
  if (!values.words.empty()) text += fmt::format(" words='{}'", fmt::join(values.words, " "));
  if (values.paths == Paths::all) text += " paths=-f";
  if (values.paths == Paths::directories) text += " paths=-d";
  if (values.separated_by_commas) text += " list=yes";
  return text.empty() ? " :" : text;
}

std::string bash_cases(const CLI::App& command) {
  std::string text;
  std::string all;
  for (const CLI::Option* const option : options_of(command)) {
    const std::vector<std::string> words = words_of(*option);
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    if (!takes_value(*option)) continue;
    std::string pattern;
    for (const std::string& word : words) {
      pattern += fmt::format("{}'{} {}'", pattern.empty() ? "" : " | ", command.get_name(), word);
    }
    text += fmt::format("    {}){} ;;\n", pattern, bash_values(values_of(*option)));
  }
  std::string arguments;
  for (const CLI::Option* const argument : arguments_of(command)) {
    arguments = bash_values(values_of(*argument));
  }
  text += fmt::format("    '{} '*) options='{}'{} ;;\n", command.get_name(), all, arguments);
  return text;
}

constexpr const char* bash_script =
    R"(# Completions of flagstone for bash, written by 'flagstone completion bash'.
_flagstone() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  local words='' options='' paths='' list='' prefix=''
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $before == '=' ]]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  if [[ $COMP_CWORD == 1 ]]; then
    words='{commands}' options='{options}'
  else
    case "${{COMP_WORDS[1]}} $before" in
{cases}    esac
  fi
  if [[ -n $options && $current == -* ]]; then
    words=$options paths=''
  fi
  if [[ -n $list && $current == *,* ]]; then
    prefix=${{current%,*}},
    current=${{current##*,}}
  fi
  mapfile -t COMPREPLY < <(
    compgen -P "$prefix" -W "$words" -- "$current"
    [[ -z $paths ]] || compgen "$paths" -- "$current"
  )
  [[ -z $paths ]] || compopt -o filenames 2> /dev/null
}}
complete -F _flagstone flagstone
)";

/// "NAME:action" of zsh's _arguments.
std::string zsh_values(const CLI::Option& option) {
  const OptionValues values = values_of(option);
  const std::string type = escaped(option.get_type_name(), ":");
  const std::string words = fmt::format("{}", fmt::join(values.words, " "));
  const char* const files = values.paths == Paths::none          ? ""
                            : values.paths == Paths::directories ? "_files -/"
                                                                 : "_files";
  if (values.words.empty()) return fmt::format("{}:{}", type, files);
  if (values.separated_by_commas) return fmt::format("{}:_values -s , {} {}", type, type, words);
  if (values.paths == Paths::none) return fmt::format("{}:({})", type, words);
  // A colon would begin the next value of the option.
  return fmt::format(R"-({}:_alternative "names\:name\:({})" "files\:file\:{}")-", type, words,
                     files);
}

std::string zsh_option(const CLI::Option& option) {
  const std::vector<std::string> words = words_of(option);
  const std::string meaning = escaped(summary_of(option), "[]\\");
  std::string text;
  for (const std::string& word : words) {
    std::string spec = takes_many(option) && takes_value(option)
                           ? "*"
                           : fmt::format("({})", fmt::join(words, " "));
    spec += word;
    if (takes_value(option)) spec += word.starts_with("--") ? "=" : "+";
    spec += fmt::format("[{}]", meaning);
    if (takes_value(option)) spec += ":" + zsh_values(option);
    text += fmt::format(" \\\n        {}", single_quoted(spec));
  }
  return text;
}

std::string zsh_case(const CLI::App& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.get_name());
  for (const CLI::Option* const option : options_of(command)) text += zsh_option(*option);
  for (const CLI::Option* const argument : arguments_of(command)) {
    text += fmt::format(" \\\n        {}", single_quoted((takes_many(*argument) ? "*:" : ":") +
                                                         zsh_values(*argument)));
  }
  return text + "\n      ;;\n";
}

constexpr const char* zsh_script = R"(#compdef flagstone
# Completions of flagstone for zsh, written by 'flagstone completion zsh'.
_flagstone() {{
  if (( CURRENT == 2 )); then
    local -a commands=(
{commands}    )
    _describe command commands
    _arguments{options}
    return
  fi
  shift words
  (( CURRENT-- ))
  case ${{words[1]}} in
{cases}  esac
}}
if [[ ${{funcstack[1]}} == _flagstone ]]; then
  _flagstone "$@"
else
  compdef _flagstone flagstone
fi
)";

std::string fish_values(const OptionValues& values) {
  std::string text;
  if (values.separated_by_commas && !values.words.empty()) {
    text += fmt::format(R"-( -a "(__fish_complete_list , 'string split \" \" \"{}\"')")-",
                        fmt::join(values.words, " "));
  } else if (!values.words.empty()) {
    text += fmt::format(" -a {}", fish_quoted(fmt::format("{}", fmt::join(values.words, " "))));
  }
  if (values.paths == Paths::all) text += " -F";
  if (values.paths == Paths::directories) text += " -a '(__fish_complete_directories)'";
  return text;
}

std::string fish_lines(const CLI::App& command) {
  const std::string begin =
      fmt::format("complete -c flagstone -n '__fish_seen_subcommand_from {}'", command.get_name());
  std::string text;
  for (const CLI::Option* const option : options_of(command)) {
    text += begin;
    for (const std::string& name : option->get_snames()) text += " -s " + name;
    for (const std::string& name : option->get_lnames()) text += " -l " + name;
    if (takes_value(*option)) {
      const OptionValues values = values_of(*option);
      text += (values.paths == Paths::all ? " -r" : " -x") + fish_values(values);
    }
    text += fmt::format(" -d {}\n", fish_quoted(summary_of(*option)));
  }
  for (const CLI::Option* const argument : arguments_of(command)) {
    const std::string values = fish_values(values_of(*argument));
    if (!values.empty()) text += begin + values + "\n";
  }
  return text;
}

}  // namespace

std::string bash_completions(const CLI::App& program) {
  std::string commands;
  std::string cases;
  std::string options;
  for (const CLI::App* const command : program.get_subcommands({})) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    cases += bash_cases(*command);
  }
  for (const CLI::Option* const option : options_of(program)) {
    for (const std::string& word : words_of(*option))
      options += (options.empty() ? "" : " ") + word;
  }
  return fmt::format(bash_script, fmt::arg("commands", commands), fmt::arg("options", options),
                     fmt::arg("cases", cases));
}

std::string zsh_completions(const CLI::App& program) {
  std::string commands;
  std::string cases;
  std::string options;
  for (const CLI::App* const command : program.get_subcommands({})) {
    commands += fmt::format("      {}\n", single_quoted(fmt::format("{}:{}", command->get_name(),
                                                                    command->get_description())));
    cases += zsh_case(*command);
  }
  for (const CLI::Option* const option : options_of(program)) options += zsh_option(*option);
  return fmt::format(zsh_script, fmt::arg("commands", commands), fmt::arg("options", options),
                     fmt::arg("cases", cases));
}

std::string fish_completions(const CLI::App& program) {
  std::string text =
      "# Completions of flagstone for fish, written by 'flagstone completion fish'.\n"
      "complete -c flagstone -f\n";
  for (const CLI::App* const command : program.get_subcommands({})) {
    text += fmt::format("complete -c flagstone -n __fish_use_subcommand -a {} -d {}\n",
                        command->get_name(), fish_quoted(command->get_description()));
  }
  for (const CLI::Option* const option : options_of(program)) {
    text += "complete -c flagstone -n __fish_use_subcommand";
    for (const std::string& name : option->get_snames()) text += " -s " + name;
    for (const std::string& name : option->get_lnames()) text += " -l " + name;
    text += fmt::format(" -d {}\n", fish_quoted(summary_of(*option)));
  }
  for (const CLI::App* const command : program.get_subcommands({})) text += fish_lines(*command);
  return text;
}

}  // namespace flagstone::cli
