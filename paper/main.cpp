// pintle-paper: the numbered results of the paper, computed anew, as a page with pictures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "paper/items.h"

namespace pintle::paper {

const std::vector<ItemEntry>& all_items() {
  static const std::vector<ItemEntry> items{
      {"figure-6", "the pendulum's joint force and angle", make_figure_6},
      {"figure-7", "compliant minus ideal pin", make_figure_7},
      {"dashpot", "damper forces", make_dashpot},
      {"solvers", "section 7's comparison of solvers", make_solvers},
      {"figure-9", "the four-bar's ground force over the crank's angle", make_figure_9},
      {"bearings", "from rubber to rolling elements", make_bearings},
      {"stiffness", "k tenfold until the digits agree", make_procedure},
      {"start", "the inconsistent start", make_start},
      {"relative", "three angles and one opened joint", make_opened},
      {"slider", "the inverted slider-crank", make_slider},
      {"sweep", "section 10's sweep of k and c", make_sweep},
      {"slips", "what the paper gets wrong, with a number each", make_slips},
  };
  return items;
}

namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

Item make(const ItemEntry& entry, const fs::path& folder) {
  Item item = entry.make();
  for (const Picture& p : item.pictures) write(folder / p.file, to_svg(p.plot));
  return item;
}

void make_page(const fs::path& folder) {
  std::vector<Item> items;
  for (const ItemEntry& entry : all_items()) {
    fmt::print(stderr, "{}: {}\n", entry.name, entry.about);
    items.push_back(make(entry, folder));
    for (const std::string& line : items.back().waiting) fmt::print(stderr, "  skipped: {}\n", line);
  }
  write(folder / "README.md", to_markdown(items));
  fmt::print("{}\n", (folder / "README.md").string());
}

void make_one(const std::string& name, const fs::path& folder) {
  for (const ItemEntry& entry : all_items()) {
    if (name != entry.name) continue;
    const Item item = make(entry, folder);
    fmt::print("{}", to_text(item));
    for (const Picture& p : item.pictures) fmt::print("{}\n", (folder / p.file).string());
    return;
  }
  throw std::runtime_error(fmt::format("there is no item '{}': see --list", name));
}

int run_program(int argc, char** argv) {
  CLI::App app("Computes the paper's numbered results and writes docs/paper: a page and its pictures.", "pintle-paper");
  std::string only, out = std::string(PINTLE_SOURCE_DIR) + "/docs/paper";
  bool list = false;
  app.add_option("--only", only, "one item: prints it and writes its pictures, not the page");
  app.add_option("--out", out, "folder that is written")->capture_default_str();
  app.add_flag("--list", list, "the items");
  CLI11_PARSE(app, argc, argv);
  if (list) {
    for (const ItemEntry& entry : all_items()) fmt::print("{:<12}{}\n", entry.name, entry.about);
    return 0;
  }
  fs::create_directories(out);
  if (only.empty())
    make_page(out);
  else
    make_one(only, out);
  return 0;
}

}  // namespace
}  // namespace pintle::paper

int main(int argc, char** argv) {
  try {
    return pintle::paper::run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pintle-paper: {}\n", error.what());
    return 1;
  }
}
