// Thousands of damaged models, always the same: each gives a model or an InputError, never anything else.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "io/test_models.h"
#include "io/writers.h"
#include "pintle/read_model.h"

namespace pintle {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) {
  return static_cast<std::size_t>(random() % n);
}

const std::vector<std::string> kPieces{"\"",
                                       "\"\"\"",
                                       "'",
                                       "[",
                                       "]",
                                       "{",
                                       "}",
                                       "=",
                                       ".",
                                       ",",
                                       "#",
                                       "\n",
                                       "\\",
                                       "\\u00",
                                       "-",
                                       "1e999",
                                       "nan",
                                       "0",
                                       "9999999999999999999",
                                       "t",
                                       "rate",
                                       "A.angle",
                                       "ground.",
                                       "^",
                                       "^-9",
                                       "/0",
                                       "(",
                                       ")",
                                       "if(",
                                       "min(",
                                       " m",
                                       "°",
                                       "\xff",
                                       "\xc3",
                                       std::string(1, '\0'),
                                       "crank",
                                       "half",
                                       "true",
                                       "null",
                                       ":",
                                       "[[joint]]",
                                       "[body.crank]",
                                       "inf",
                                       "0x1F",
                                       "1979-05-27"};

void mutate(std::string& text, Random& random) {
  const std::size_t at = below(random, text.size());
  const std::size_t length = 1 + below(random, 12);
  switch (below(random, 5)) {
    case 0:
      text.erase(at, length);
      break;
    case 1:
      text.insert(at, kPieces[below(random, kPieces.size())]);
      break;
    case 2:
      text.insert(at, text.substr(below(random, text.size()), 4 * length));
      break;
    case 3:
      text[at] = static_cast<char>(random() & 0xFFU);
      break;
    default:
      text.replace(at, length, kPieces[below(random, kPieces.size())]);
  }
  if (text.empty()) text = "x";
}

// Whether it could be read.
bool try_to_read(const std::string& text, const std::string& name, const std::vector<std::string>& overrides = {}) {
  try {
    parse_model(text, name, overrides);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.complaints().empty());
    return false;
  }
}

void try_to_format(const std::string& text) {
  try {
    const std::string once = format_toml(text, "x.toml");
    EXPECT_EQ(format_toml(once, "x.toml"), once) << text;
  } catch (const InputError&) {
    // Not TOML.
  }
}

TEST(Mutation, TomlModels) {
  Random random(20080803);
  int read = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = kFullModel;
    for (std::size_t n = 1 + below(random, 4); n > 0; --n) mutate(text, random);
    read += try_to_read(text, "x.toml") ? 1 : 0;
    if (i % 4 == 0) try_to_format(text);
  }
  EXPECT_GT(read, 10);  // damage to comments, names and numbers can leave a valid model
}

TEST(Mutation, JsonModels) {
  Random random(20080804);
  const std::string json = to_json(parse_document(kFullModel, "x.toml"));
  for (int i = 0; i < 2000; ++i) {
    std::string text = json;
    for (std::size_t n = 1 + below(random, 3); n > 0; --n) mutate(text, random);
    try_to_read(text, "x.json");
  }
}

TEST(Mutation, Overrides) {
  Random random(20080805);
  for (int i = 0; i < 1000; ++i) {
    std::string text = "joint.A.stiffness=[\"1e6 N/m\", 2e6]";
    for (std::size_t n = 1 + below(random, 3); n > 0; --n) mutate(text, random);
    try_to_read(kFullModel, "x.toml", {text});
  }
}

}  // namespace
}  // namespace pintle
