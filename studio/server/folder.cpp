#include "studio/server/folder.h"

#include <algorithm>

#include "io/document.h"
#include "io/model_files.h"
#include "pintle/results.h"
#include "results/disk.h"
#include "results/sha256.h"

namespace pintle::studio {
namespace fs = std::filesystem;
namespace {

constexpr int kDeepest = 4;                // folders below the root that are listed
constexpr std::size_t kMostListed = 2000;

bool is_model_name(const fs::path& path) { return path.extension() == ".toml" || path.extension() == ".json"; }

fs::path joined(const fs::path& root, const std::vector<std::string>& names) {
  fs::path out = root;
  for (const std::string& name : names) out /= name;
  return out;
}

}  // namespace

Folder::Folder(const fs::path& root) {
  std::error_code error;
  root_ = fs::canonical(root, error);
  if (error || !fs::is_directory(root_, error)) throw FileError(root.string() + ": there is no such folder");
}

bool Folder::holds(const fs::path& canonical) const {
  const auto [end, at] = std::mismatch(root_.begin(), root_.end(), canonical.begin(), canonical.end());
  return end == root_.end();
}

std::optional<fs::path> Folder::find(std::string_view path) const {
  std::error_code error;
  const fs::path file = fs::canonical(joined(root_, names_of_path(path)), error);
  if (error) return {};
  if (!holds(file)) throw Refusal(403, "This path leads out of the folder.");
  return fs::is_regular_file(file, error) ? std::optional(file) : std::nullopt;
}

fs::path Folder::place_for(std::string_view path) const {
  const fs::path wanted = joined(root_, names_of_path(path));
  std::error_code error;
  const fs::path parent = fs::canonical(wanted.parent_path(), error);
  if (error || !fs::is_directory(parent, error)) throw Refusal(404, "There is no such folder.", "Make the folder first, or choose another one.");
  if (!holds(parent)) throw Refusal(403, "This path leads out of the folder.");
  const fs::path place = parent / wanted.filename();
  // A link that leads nowhere, a folder, a pipe: what is there and is no regular file is not replaced.
  if (fs::symlink_status(place, error).type() != fs::file_type::not_found) throw Refusal(403, "What is at this path is not a model file.");
  return place;
}

void ModelFolder::demand_model_name(std::string_view path) {
  if (!is_model_name(fs::path(path))) throw Refusal(400, "Only model files are read and written.", "A name that ends in .toml or .json.");
}

std::vector<ModelFile> ModelFolder::list() const {
  std::vector<ModelFile> files;
  std::error_code error;
  fs::recursive_directory_iterator it(folder_.root(), fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && it != end && files.size() < kMostListed; it.increment(error)) {
    std::error_code ignored;
    const bool hidden = it->path().filename().string().starts_with('.');
    const bool folder = it->is_directory(ignored) && !it->is_symlink(ignored);
    if (folder && (hidden || it.depth() >= kDeepest)) it.disable_recursion_pending();
    if (hidden || it->is_symlink(ignored) || !it->is_regular_file(ignored) || !is_model_name(it->path())) continue;
    files.push_back({it->path().lexically_relative(folder_.root()).generic_string(), it->file_size(ignored)});
  }
  std::sort(files.begin(), files.end(), [](const ModelFile& a, const ModelFile& b) { return a.path < b.path; });
  return files;
}

ModelText ModelFolder::open(std::string_view path) const {
  demand_model_name(path);
  const std::optional<fs::path> file = folder_.find(path);
  if (!file) throw Refusal(404, "There is no such model file.");
  std::string text = read_file(*file, kMaxFileBytes + 1);
  if (text.size() > kMaxFileBytes) throw Refusal(413, "This file is too large for a model.");
  try {
    if (!text.empty()) check_text(text, path);
  } catch (const InputError&) {
    throw Refusal(422, "This file is not UTF-8 text.");
  }
  std::string hash = sha256(text);
  std::map<std::string, std::string> files = files_of(path, text);
  return {std::move(text), std::move(hash), std::move(files)};
}

std::map<std::string, std::string> ModelFolder::files_of(std::string_view path, const std::string& text) const {
  std::map<std::string, std::string> files;
  std::vector<std::string> names;
  try {
    names = files_named_in(parse_document(text, path));
  } catch (const InputError&) {
    return files;  // the page says what is wrong with it
  }
  for (const std::string& name : names) {
    try {
      const std::optional<fs::path> file = folder_.find((fs::path(path).parent_path() / name).generic_string());
      if (file && fs::file_size(*file) <= kMaxFileBytes) files[name] = read_file(*file);
    } catch (const std::runtime_error&) {
      continue;  // out of the folder, or not readable: the model is complained about where it names it
    }
  }
  return files;
}

ModelFolder::Saved ModelFolder::save(std::string_view path, const std::string& text, const std::optional<std::string>& expected) {
  demand_model_name(path);
  if (text.size() > kMaxFileBytes) throw Refusal(413, "This text is too large for a model.");
  const std::lock_guard lock(saving_);
  const std::optional<fs::path> file = folder_.find(path);
  if (!file) {
    if (expected) return {};
    write_file(folder_.place_for(path), text);
    return {true, sha256(text), {}};
  }
  const std::string now = read_file(*file, kMaxFileBytes + 1), hash = sha256(now);
  if (!expected || *expected != hash) return {false, hash, now};
  write_file(*file, text);
  return {true, sha256(text), {}};
}

}  // namespace pintle::studio
