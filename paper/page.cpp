#include "paper/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pintle::paper {
namespace {

constexpr const char* kProgram = "build/release/bin/pintle-paper";

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return "pass";
    case Verdict::kPartly:
      return "in part";
    default:
      return "**fail**";
  }
}

std::string row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string rows(const Table& table) {
  std::string out = row(table.head) + "|";
  for (std::size_t i = 0; i < table.head.size(); ++i) out += " --- |";
  out += '\n';
  for (const auto& cells : table.rows) out += row(cells);
  return out;
}

std::string to_markdown(const Table& table) {
  return fmt::format("{}:\n\n{}", table.title, rows(table));
}

Table claim_table(const Item& item) {
  Table table{"", {"section", "the paper says", "found here", ""}, {}};
  for (const Claim& c : item.claims) table.rows.push_back({c.section, c.text, c.ours, word(c.verdict)});
  return table;
}

void append(std::string& out, const std::string& block) {
  if (!out.empty()) out += '\n';
  out += block;
}

constexpr const char* kHead =
    R"(# The paper, reproduced

Every numbered result of G. H. Sutherland, *Mechanism analysis using implicit constraints*, DETC2008-49020, recomputed. A program
generates this page and its pictures from the models in [mechanisms/](../../mechanisms/README.md):

```sh
make paper      # this page
make figure9    # Figure 9 only
build/release/bin/pintle-paper --list
build/release/bin/pintle-paper --only figure-9
```

*pass*: the number found here agrees with the paper's statement. *in part*: it agrees under one interpretation or for some cases, as the
text explains. ***fail***: it does not agree. If the paper leaves something open (gravity, the initial crank angle, the joints'
initial state), the assumption made here is stated; [theory](../theory/README.md) lists these too.

## All claims

)";

}  // namespace

Verdict verdict(bool holds) {
  return holds ? Verdict::kHolds : Verdict::kFails;
}

std::string to_markdown(const Item& item) {
  std::string out = fmt::format("## {}\n\n`{} --only {}`\n", item.title, kProgram, item.name);
  for (const std::string& paragraph : item.text) append(out, paragraph + "\n");
  if (!item.claims.empty()) append(out, rows(claim_table(item)));
  for (const Picture& p : item.pictures) append(out, fmt::format("![{}]({})\n\n*{}*\n", p.plot.title, p.file, p.caption));
  for (const Table& table : item.tables) append(out, to_markdown(table));
  for (const std::string& line : item.waiting) append(out, fmt::format("Not available in this version: {}.\n", line));
  return out;
}

std::string to_markdown(const std::vector<Item>& items) {
  Table all{"", {"section", "the paper says", "found here", "", "by `--only`"}, {}};
  int passed = 0, partly = 0;
  for (const Item& item : items)
    for (const Claim& c : item.claims) {
      all.rows.push_back({c.section, c.text, c.ours, word(c.verdict), fmt::format("`{}`", item.name)});
      passed += c.verdict == Verdict::kHolds;
      partly += c.verdict == Verdict::kPartly;
    }
  std::string out = kHead + rows(all);
  const int total = static_cast<int>(all.rows.size());
  out += fmt::format("\n{} claims: {} pass, {} in part, {} fail.\n", total, passed, partly, total - passed - partly);
  for (const Item& item : items) append(out, to_markdown(item));
  return out;
}

std::string to_text(const Item& item) {
  std::string out = item.title + "\n";
  for (const Claim& c : item.claims)
    out += fmt::format("  [{}] section {}: {}\n      found: {}\n", word(c.verdict), c.section, c.text, c.ours);
  for (const Table& table : item.tables) {
    out += fmt::format("  {}\n", table.title);
    out += fmt::format("    {}\n", fmt::join(table.head, "; "));
    for (const auto& cells : table.rows) out += fmt::format("    {}\n", fmt::join(cells, "; "));
  }
  for (const std::string& line : item.waiting) out += fmt::format("  skipped: {}\n", line);
  return out;
}

}  // namespace pintle::paper
