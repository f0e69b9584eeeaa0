// What one numbered result of the paper becomes: claims and what is found of them, tables, pictures.
#pragma once

#include <string>
#include <vector>

#include "results/plots/svg_plot.h"

namespace pintle::paper {

enum class Verdict { kHolds, kPartly, kFails };

/// A statement of the paper and the number that we find for it.
struct Claim {
  std::string section, text, ours;
  Verdict verdict = Verdict::kHolds;
};

struct Table {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

struct Picture {
  std::string file;  ///< "figure-9.svg"
  std::string caption;
  Plot plot;
};

struct Item {
  std::string name, title;
  std::vector<std::string> text;  ///< paragraphs
  std::vector<Claim> claims;
  std::vector<Table> tables;
  std::vector<Picture> pictures;
  std::vector<std::string> waiting;  ///< what this program cannot do yet, a line each
};

/// kHolds or kFails.
Verdict verdict(bool holds);

/// The item as Markdown, its pictures by their file names.
std::string to_markdown(const Item& item);
/// The whole page: all claims in one table, then item by item.
std::string to_markdown(const std::vector<Item>& items);
/// For the console.
std::string to_text(const Item& item);

}  // namespace pintle::paper
