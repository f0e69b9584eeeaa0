// The sockets of the studio's server. Reachable from this machine only: 127.0.0.1.
#pragma once

#include <functional>
#include <memory>

#include "studio/server/request_router.h"

namespace pintle::cli {

class WebServer {
 public:
  /// Listens at `port`; if that is taken, at one of the `more` ports after it; else (and for 0) at any free one. Throws FileError if there is none.
  WebServer(int port, int more);
  ~WebServer();
  int port() const { return port_; }

  /// Answers requests until `goes_on` returns false; it is called about ten times a second.
  void serve(studio::RequestRouter& router, const std::function<bool()>& goes_on);

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
  int port_ = 0;
};

}  // namespace pintle::cli
