// The files that the server may touch: the models in the folder that it was started in, and the pages of the studio.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/server/exchange.h"

namespace pintle::studio {

/// A folder, and what lies in it after all links have been followed. Everything else is refused.
class Folder {
 public:
  /// Throws FileError if there is no such folder.
  explicit Folder(const std::filesystem::path& root);

  const std::filesystem::path& root() const { return root_; }
  /// The regular file at `path`, links followed; nothing if there is no such file. Throws Refusal for a path that leads out.
  std::optional<std::filesystem::path> find(std::string_view path) const;
  /// Where a file at `path` would be: in a folder that exists.
  std::filesystem::path place_for(std::string_view path) const;

 private:
  bool holds(const std::filesystem::path& canonical) const;
  std::filesystem::path root_;
};

struct ModelFile {
  std::string path;  // below the folder
  std::uintmax_t size = 0;
};

struct ModelText {
  std::string text, hash;
  std::map<std::string, std::string> files{};  // the texts of the files that it names, as far as they are in the folder
};

class ModelFolder {
 public:
  explicit ModelFolder(const std::filesystem::path& root) : folder_(root) {}

  const std::filesystem::path& root() const { return folder_.root(); }
  /// Model files here and a few folders down, in the order of their paths.
  std::vector<ModelFile> list() const;
  /// Throws Refusal 404 when it is not there.
  ModelText open(std::string_view path) const;
  /// Writes the file if what is there now has the hash `expected` (nothing: if there is no file). Otherwise gives what is there.
  struct Saved {
    bool done = false;
    std::string hash;                  // of what is in the file now
    std::optional<std::string> other;  // its text, when it was not written; nothing: the file is gone
  };
  Saved save(std::string_view path, const std::string& text, const std::optional<std::string>& expected);

 private:
  static void demand_model_name(std::string_view path);
  std::map<std::string, std::string> files_of(std::string_view path, const std::string& text) const;
  Folder folder_;
  std::mutex saving_;
};

}  // namespace pintle::studio
