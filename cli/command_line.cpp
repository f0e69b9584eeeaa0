#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "base/text/did_you_mean.h"

namespace pintle::cli {
namespace {

std::string remembered;

const CLI::App& chosen_verb(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : *chosen.front();
}

/// The words that would be valid in place of `word`.
std::vector<std::string> candidates(const CLI::App& verb, const std::string& word) {
  std::vector<std::string> names;
  if (word.rfind('-', 0) == 0) {
    for (const CLI::Option* option : verb.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  } else {
    for (const CLI::App* other : verb.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(other->get_name());
  }
  return names;
}

/// The first word that the parser did not understand; empty if it complains about something else.
std::string first_stranger(const CLI::App& app, const CLI::App& verb) {
  for (const std::string& word : verb.remaining()) return word;
  for (const std::string& word : app.remaining(true)) return word;
  return "";
}

}  // namespace

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

void remember_command_line(int n_words, const char* const* words) {
  remembered = n_words > 0 ? std::filesystem::path(words[0]).filename().string() : "pintle";
  for (int i = 1; i < n_words; ++i) remembered += " " + shell_word(words[i]);
}

const std::string& command_line() {
  return remembered;
}

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& verb = chosen_verb(app);
  const std::string name = &verb == &app ? "pintle" : "pintle " + verb.get_name();
  std::string text = fmt::format("{}: ", name);
  const std::string stranger = first_stranger(app, verb);
  if (stranger.empty()) {
    text += fmt::format("{}.\n", error.what());
  } else {
    const bool verb_missing = &verb == &app && stranger.rfind('-', 0) != 0;
    text += fmt::format("found \"{}\": {}.", stranger,
                        verb_missing ? "there is no such verb" : "this verb has no such option or argument");
    if (const auto meant = did_you_mean(stranger, candidates(verb, stranger)))
      text += fmt::format(" Did you mean {}?", *meant);
    text += "\n";
  }
  return text + fmt::format("    Try {} --help.\n", name);
}

}  // namespace pintle::cli
