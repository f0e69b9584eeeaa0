#include "cli/studio/web_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <memory>
#include <thread>

#include "pintle/results.h"

namespace pintle::cli {
namespace {

constexpr const char* kAddress = "127.0.0.1";
constexpr std::size_t kLargestBody = std::size_t{96} << 20U;  // the largest model, as JSON text
constexpr int kPatience = 5;                                  // timeout of a silent connection [s]

// The library compresses the text it sends, unless the client requests only part of it.
void set_compressed(std::string body, const char* type, httplib::Response& to) {
  const auto kept = std::make_shared<const std::string>(std::move(body));
  to.set_content_provider(kept->size(), type, [kept](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
    sink.write(kept->data() + offset, length);
    return true;
  });
}

studio::Request request_of(const httplib::Request& from) {
  studio::Request request{from.method, from.target, {}, from.body};
  for (const auto& [name, value] : from.headers) {
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    request.headers.emplace(std::move(lower), value);
  }
  return request;
}

}  // namespace

struct WebServer::Sockets {
  httplib::Server server;
};

WebServer::WebServer(int port, int more) : sockets_(std::make_unique<Sockets>()) {
  httplib::Server& server = sockets_->server;
  // Without SO_REUSEPORT, so that no other program can listen at the same port.
  server.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_payload_max_length(kLargestBody);
  server.set_read_timeout(kPatience);
  server.set_write_timeout(kPatience);
  server.set_keep_alive_timeout(kPatience);
  server.set_keep_alive_max_count(1000);
  for (int i = 0; i <= more && port > 0 && port_ <= 0; ++i)
    if (server.bind_to_port(kAddress, port + i)) port_ = port + i;
  if (port_ <= 0) port_ = server.bind_to_any_port(kAddress);
  if (port_ <= 0) throw FileError("pintle studio finds no free port on 127.0.0.1");
}

WebServer::~WebServer() = default;

void WebServer::serve(studio::RequestRouter& router, const std::function<bool()>& goes_on) {
  httplib::Server& server = sockets_->server;
  const auto answer = [&router](const httplib::Request& from, httplib::Response& to) {
    studio::Reply reply = router.answer(request_of(from));
    to.status = reply.status;
    for (const auto& [name, value] : reply.headers) to.set_header(name.c_str(), value);
    if (to.has_header("Content-Encoding")) set_compressed(std::move(reply.body), reply.type.c_str(), to);
    else to.set_content(std::move(reply.body), reply.type.c_str());
  };
  // [\s\S] instead of a dot, which does not match line endings.
  constexpr const char* kAnything = R"([\s\S]*)";
  server.Get(kAnything, answer).Post(kAnything, answer).Put(kAnything, answer).Delete(kAnything, answer).Patch(kAnything, answer).Options(kAnything, answer);
  // A server that is not running yet cannot be stopped.
  std::atomic<bool> ended = false;
  std::thread watch([&] {
    while (goes_on() && !ended) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    while (!server.is_running() && !ended) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    server.stop();
  });
  const auto end = [&] {
    ended = true;
    watch.join();
  };
  bool listened = false;
  try {
    listened = server.listen_after_bind();
  } catch (...) {
    end();
    throw;
  }
  const bool asked_to = !goes_on();
  end();
  if (!listened && !asked_to) throw FileError(fmt::format("pintle studio cannot listen at port {} any more", port_));
}

}  // namespace pintle::cli
