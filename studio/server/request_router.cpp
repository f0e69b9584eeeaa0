#include "studio/server/request_router.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <random>

#include "pintle/results.h"
#include "results/disk.h"

namespace pintle::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kEnter = "/enter/";
constexpr const char* kPolicy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self' blob:; worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

constexpr std::array<std::pair<std::string_view, const char*>, 14> kTypes{{{".html", "text/html; charset=utf-8"},
                                                                          {".js", "text/javascript; charset=utf-8"},
                                                                          {".mjs", "text/javascript; charset=utf-8"},
                                                                          {".css", "text/css; charset=utf-8"},
                                                                          {".json", "application/json"},
                                                                          {".wasm", "application/wasm"},
                                                                          {".svg", "image/svg+xml"},
                                                                          {".png", "image/png"},
                                                                          {".ico", "image/x-icon"},
                                                                          {".woff2", "font/woff2"},
                                                                          {".toml", "text/plain; charset=utf-8"},
                                                                          {".txt", "text/plain; charset=utf-8"},
                                                                          {".map", "application/json"},
                                                                          {".webmanifest", "application/manifest+json"}}};

std::string type_of(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  const auto it = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return type.first == ending; });
  return it == kTypes.end() ? "application/octet-stream" : it->second;
}

Reply json_reply(int status, const Json& json) {
  return {status, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace), {{"Cache-Control", "no-store"}}};
}

Reply fault_reply(int status, const std::string& message, const std::string& hint) {
  return json_reply(status, {{"fault", {{"message", message}, {"hint", hint}}}});
}

// As long as it takes whatever the first difference is.
bool same_secret(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

// Whether the browser takes `coding`, one of a list such as "gzip, deflate, br;q=0.5".
bool accepts(const Request& request, std::string_view coding) {
  std::string listed = request.header("accept-encoding");
  std::erase(listed, ' ');
  for (std::size_t at = 0; at < listed.size();) {
    const std::size_t end = std::min(listed.find(',', at), listed.size());
    const std::string_view one = std::string_view(listed).substr(at, end - at);
    if (one.substr(0, one.find(';')) == coding) return one.find(";q=0") == one.npos || one.find_first_of("123456789", one.find(';')) != one.npos;
    at = end + 1;
  }
  return false;
}

// The value of `key` in "a=1&b=2".
std::string query_value(const std::string& query, const std::string& key) {
  std::size_t at = 0;
  while (at < query.size()) {
    const std::size_t end = std::min(query.find('&', at), query.size());
    const std::string part = query.substr(at, end - at);
    if (part.starts_with(key + "=")) return decoded(part.substr(key.size() + 1));
    at = end + 1;
  }
  throw Refusal(400, fmt::format("The request lacks \"{}\".", key));
}

Json body_of(const Request& request) {
  Json body;
  try {
    body = Json::parse(request.body);
  } catch (const Json::exception& error) {
    throw Refusal(400, "The body is not JSON.", error.what());
  }
  if (!body.is_object()) throw Refusal(400, "The body is not a JSON object.");
  return body;
}

std::string text_in(const Json& body, const char* key) {
  const auto it = body.find(key);
  if (it == body.end() || !it->is_string()) throw Refusal(400, fmt::format("The body lacks the string \"{}\".", key));
  return it->get<std::string>();
}

void demand_method(const Request& request, std::string_view method) {
  if (request.method != method) throw Refusal(405, fmt::format("Use {} for this request.", method));
}

int run_number(std::string_view text) {
  int id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc() || end != text.data() + text.size()) throw Refusal(400, "The run number is invalid.");
  return id;
}

}  // namespace

std::string random_token() {
  std::random_device source;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", source() & 0xFFFFFFFFU);
  return token;
}

RequestRouter::RequestRouter(const RouterSettings& settings) : settings_(settings), pages_(settings.pages), models_(settings.models) {}

Reply RequestRouter::answer(const Request& request) {
  Reply reply;
  try {
    const std::size_t mark = std::min(request.target.find('?'), request.target.size());
    const std::string path = decoded(std::string_view(request.target).substr(0, mark));
    const std::string query = mark < request.target.size() ? request.target.substr(mark + 1) : "";
    const bool is_api = path == "/api" || path.starts_with("/api/");
    demand_own_page(request, is_api);
    if (is_api) reply = api(request, path.substr(std::min<std::size_t>(5, path.size())), query);
    else reply = path.starts_with(kEnter) ? enter(path.substr(kEnter.size())) : page(request, path);
  } catch (const Refusal& refusal) {
    reply = fault_reply(refusal.status, refusal.what(), refusal.hint);
  } catch (const FileError& error) {
    reply = fault_reply(500, error.what(), "");
  } catch (const std::bad_alloc&) {
    reply = fault_reply(500, "There is not enough memory for this.", "");
  } catch (const std::exception& error) {
    reply = fault_reply(500, fmt::format("The server failed: {}", error.what()), "Please report it.");
  }
  for (const auto& [name, value] : {std::pair<const char*, const char*>{"Content-Security-Policy", kPolicy},
                                    {"X-Content-Type-Options", "nosniff"},
                                    {"X-Frame-Options", "DENY"},
                                    {"Referrer-Policy", "no-referrer"},
                                    {"Cross-Origin-Opener-Policy", "same-origin"},
                                    {"Cross-Origin-Resource-Policy", "same-origin"}})
    reply.headers.emplace_back(name, value);
  return reply;
}

// A page of another site can send requests here, and a name of its own can be made to mean 127.0.0.1. Neither has our Host and
// Origin, nor knows the token.
void RequestRouter::demand_own_page(const Request& request, bool is_api) const {
  const std::string host = request.header("host");
  const std::array<std::string, 2> own{fmt::format("127.0.0.1:{}", settings_.port), fmt::format("localhost:{}", settings_.port)};
  if (std::find(own.begin(), own.end(), host) == own.end()) throw Refusal(403, "This server accepts 127.0.0.1 only.", "Open the address that pintle studio printed.");
  if (request.has("origin") && request.header("origin") != "http://" + host) throw Refusal(403, "This page has another origin.");
  if (!is_api) return;
  if (request.has("sec-fetch-site") && request.header("sec-fetch-site") != "same-origin") throw Refusal(403, "This page has another origin.");
  if (!same_secret(request.header("x-pintle-token"), settings_.token)) throw Refusal(401, "The request lacks this session's token.", "Open the address that pintle studio printed.");
}

Reply RequestRouter::page(const Request& request, const std::string& path) const {
  if (request.method != "GET" && request.method != "HEAD") throw Refusal(405, "Pages are read only.");
  const std::string name = path == "/" ? "index.html" : path.substr(std::min<std::size_t>(1, path.size()));
  const std::optional<std::filesystem::path> file = pages_.find(name);
  if (!file) throw Refusal(404, "There is no such page.");
  const std::optional<std::filesystem::path> packed = accepts(request, "br") ? pages_.find(name + ".br") : std::nullopt;
  Reply reply{200, type_of(*file), read_file(packed.value_or(*file)), {{"Vary", "Accept-Encoding"}}};
  if (packed) reply.headers.emplace_back("Content-Encoding", "br");
  // The names of what Vite builds change with their content.
  reply.headers.emplace_back("Cache-Control", name.starts_with("assets/") ? "public, max-age=31536000, immutable" : "no-cache");
  return reply;
}

// A program's arguments can be read by everybody on the machine: the address that a browser is started with is good for one use.
Reply RequestRouter::enter(const std::string& ticket) {
  if (settings_.ticket.empty() || !same_secret(ticket, settings_.ticket) || entered_.exchange(true))
    throw Refusal(410, "This address has already been used.", "Open the one that pintle studio printed.");
  return {303, "text/plain; charset=utf-8", "", {{"Location", "/#token=" + settings_.token}, {"Cache-Control", "no-store"}}};
}

Reply RequestRouter::api(const Request& request, const std::string& path, const std::string& query) {
  if (path == "about" || path == "models") {
    demand_method(request, "GET");
    return path == "about" ? about() : list();
  }
  if (path == "model") {
    if (request.method == "PUT") return save(request);
    demand_method(request, "GET");
    return open(query);
  }
  if (path == "runs" || path.starts_with("runs/")) return run(request, path);
  throw Refusal(404, "The server has no such endpoint.");
}

Reply RequestRouter::about() const {
  return json_reply(200, {{"version", PINTLE_VERSION},
                          {"folder", models_.root().filename().string()},
                          {"model", settings_.model.empty() ? Json(nullptr) : Json(settings_.model)}});
}

Reply RequestRouter::list() const {
  Json files = Json::array();
  for (const ModelFile& file : models_.list()) files.push_back({{"path", file.path}, {"size", file.size}});
  return json_reply(200, {{"models", files}});
}

Reply RequestRouter::open(const std::string& query) const {
  const std::string path = query_value(query, "path");
  const ModelText model = models_.open(path);
  return json_reply(200, {{"path", path}, {"text", model.text}, {"hash", model.hash}, {"files", model.files}});
}

Reply RequestRouter::save(const Request& request) {
  const Json body = body_of(request);
  const auto expected = body.find("expected");
  if (expected == body.end() || !(expected->is_null() || expected->is_string()))
    throw Refusal(400, "The body lacks \"expected\": the hash of the file to replace, or null for a new file.");
  const ModelFolder::Saved saved =
      models_.save(text_in(body, "path"), text_in(body, "text"), expected->is_null() ? std::nullopt : std::optional(expected->get<std::string>()));
  if (saved.done) return json_reply(200, {{"hash", saved.hash}});
  Json out = {{"fault", {{"message", "The file was changed elsewhere since it was opened."}, {"hint", "Compare both, then keep one, or save under another name."}}}};
  out["hash"] = saved.other ? Json(saved.hash) : Json(nullptr);
  out["text"] = saved.other ? Json(*saved.other) : Json(nullptr);
  return json_reply(409, out);
}

Reply RequestRouter::run(const Request& request, const std::string& path) {
  if (path == "runs") {
    demand_method(request, "POST");
    const Json body = body_of(request);
    text_in(body, "text");
    return json_reply(200, {{"id", runs_.start(request.body)}});
  }
  const std::string rest = path.substr(5);
  const std::size_t slash = rest.find('/');
  const int id = run_number(std::string_view(rest).substr(0, slash));
  if (slash != std::string::npos) {
    if (rest.substr(slash + 1) != "result") throw Refusal(404, "The server has no such endpoint.");
    demand_method(request, "GET");
    return {200, "application/octet-stream", runs_.result(id), {{"Cache-Control", "no-store"}}};
  }
  if (request.method == "DELETE") {
    runs_.end(id);
    return json_reply(200, Json::object());
  }
  demand_method(request, "GET");
  return {200, "application/json", runs_.state(id), {{"Cache-Control", "no-store"}}};
}

}  // namespace pintle::studio
