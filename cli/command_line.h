// The command line as typed, and what is wrong with it.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace pintle::cli {

/// Kept for the record of a run: main() stores it, quoted so that a shell would read the same words.
void remember_command_line(int n_words, const char* const* words);
const std::string& command_line();

/// The word, quoted so that a shell reads it as one word.
std::string shell_word(const std::string& word);

/// Explains what is wrong, and suggests the verb or option that was probably meant.
std::string explain(const CLI::App& app, const CLI::ParseError& error);

}  // namespace pintle::cli
