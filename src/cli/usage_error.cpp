// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/usage_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Error.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "cli/help.hpp"
#include "library/core/did_you_mean.hpp"

namespace flagstone::cli {
namespace {

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* const command : program.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  return names;
}

/// "did you mean 'X'?; ", or nothing.
std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  const std::string_view nearest = closest_name(word, names);
  return nearest.empty() ? "" : fmt::format("did you mean '{}'?; ", nearest);
}

std::string unexpected_argument(const CLI::App& command, const std::string& see) {
  std::string word;
  for (const std::string& argument : command.remaining()) {
    if (word.empty() || (argument.starts_with('-') && !word.starts_with('-'))) word = argument;
  }
  word = word.substr(0, word.find('='));
  if (!word.starts_with('-')) return fmt::format("{}: unexpected argument ({})", word, see);
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return fmt::format("{}: is not an option of this command ({}{})", word, suggestion(word, names),
                     see);
}

std::string missing_argument(const CLI::App& program, const CLI::App& command,
                             const std::string& see) {
  for (const CLI::Option* const option : command.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    return fmt::format("{}: {} is missing ({})", command.get_name(), label_of(*option), see);
  }
  return fmt::format("no command given (expected {}; {})", fmt::join(command_names(program), ", "),
                     see);
}

/// Replaces the first `from` in `text`.
std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string wrong_count(const CLI::App& command, const std::string& message,
                        const std::string& see) {
  const std::string name = message.substr(0, message.find(": "));
  const CLI::Option* const option = command.get_option_no_throw(name);
  if (option == nullptr) return fmt::format("{} ({})", message, see);
  if (option->count() > 1) return fmt::format("{}: is given more than once (expected once)", name);
  return fmt::format("{}: has no value (expected {}; {})", name, option->get_type_name(), see);
}

template <class Error>
bool is(const CLI::ParseError& error) {
  return dynamic_cast<const Error*>(&error) != nullptr;
}

}  // namespace

std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() ? program : *chosen.front();
  const std::string see = chosen.empty()
                              ? "see 'flagstone --help'"
                              : fmt::format("see 'flagstone {} --help'", command.get_name());
  if (is<CLI::ValidationError>(error)) return error.what();
  const std::string message = error.what();
  if (is<CLI::ExtrasError>(error)) return unexpected_argument(command, see);
  if (is<CLI::RequiredError>(error)) return missing_argument(program, command, see);
  if (is<CLI::ArgumentMismatch>(error)) return wrong_count(command, message, see);
  if (is<CLI::RequiresError>(error)) return replaced(message, " requires ", ": needs ");
  if (is<CLI::ExcludesError>(error)) {
    return replaced(message, " excludes ", ": cannot be combined with ");
  }
  return fmt::format("{} ({})", message, see);
}

void check_command(const CLI::App& program, std::string_view word) {
  const std::vector<std::string> names = command_names(program);
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return;
  const std::string nearest = suggestion(word, names);
  throw std::invalid_argument(fmt::format(
      "{}: is not a command ({}see 'flagstone --help')", word,
      nearest.empty() ? fmt::format("expected {}; ", fmt::join(names, ", ")) : nearest));
}

}  // namespace flagstone::cli
