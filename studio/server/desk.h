// The server of the studio without its sockets: access control, requests, responses. docs/reference/studio-server.md
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "studio/server/exchange.h"
#include "studio/server/folder.h"
#include "studio/server/run_jobs.h"

namespace pintle::studio {

struct DeskSettings {
  std::filesystem::path pages;   // the built studio
  std::filesystem::path models;  // the folder whose models are read and written
  std::string model;             // to open first, below that folder; may be empty
  int port = 0;
  std::string token;             // that every question to the API must show
  std::string ticket{};          // /enter/<ticket> leads to the page with its token, once; empty: nothing does
};

/// 32 random hexadecimal digits.
std::string random_token();

class Desk {
 public:
  explicit Desk(const DeskSettings& settings);

  /// Never throws. May be called by several threads at once.
  Reply answer(const Request& request);

 private:
  void demand_own_page(const Request& request, bool api) const;
  Reply page(const Request& request, const std::string& path) const;
  Reply enter(const std::string& ticket);
  Reply api(const Request& request, const std::string& path, const std::string& query);
  Reply about() const;
  Reply list() const;
  Reply open(const std::string& query) const;
  Reply save(const Request& request);
  Reply run(const Request& request, const std::string& path);

  DeskSettings settings_;
  Folder pages_;
  ModelFolder models_;
  RunJobs runs_;
  std::atomic<bool> entered_ = false;
};

}  // namespace pintle::studio
