// The steps from a document to a model. Each reads one part of the file and complains about what is wrong with it.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/complaints.h"
#include "io/reading/record.h"
#include "io/schema/schema.h"
#include "pintle/model.h"
#include "pintle/read_model.h"

namespace pintle {

/// A table of the model: the function that expressions call, and its points [SI] (none if the table was complained about).
struct NamedTable {
  ParseScope::Table in_scope;
  std::vector<double> x, y;
};

/// Data shared by the steps.
struct ModelReading {
  explicit ModelReading(const Document& document, FileText files = {})
      : root(*document.root.table()), complaints(document), records(complaints), file_text(std::move(files)) {}

  const Table& root;
  Complaints complaints;
  RecordReader records;
  Model model;
  FileText file_text;                                                    // text of the files that tables name; empty: no files
  std::map<std::string, NamedTable, std::less<>> tables;                 // by name
  std::map<std::string, std::set<std::string>, std::less<>> markers_of;  // by body, including "ground"
  std::map<std::string, std::string, std::less<>> type_of_joint;         // by joint, including faulty joints
  std::map<std::string, TableSpec, std::less<>> specs;                   // assembled ones, by path and kind

  /// The assembled table of the schema, made once.
  const TableSpec& spec(const std::string& path, const std::string& when = {}, const std::string& law = {}, const std::string& friction = {}, const std::string& stops = {},
                        const std::string& detent = {});
};

void read_settings(ModelReading& reading);    // the file's head, [simulate]
void read_parameters(ModelReading& reading);  // first: every other value may use parameters
void read_tables(ModelReading& reading);      // [table]: the expressions read after it may call tables
void read_bodies(ModelReading& reading);      // [ground], [body]
void read_joints(ModelReading& reading);      // [defaults.joint], [joint]
/// From then on, expressions may call `reading.tables`.
void let_expressions_call_tables(ModelReading& reading);
/// From then on, expressions "of joints" may read coordinates of joints, bodies and markers.
void let_expressions_read_coordinates(ModelReading& reading);
void read_loads(ModelReading& reading);       // [spring], [torsion_spring], [force]
void read_motors(ModelReading& reading);      // [motor]
void check_record(ModelReading& reading);     // simulate.record, once bodies and joints are known

/// All of these in their order, except [variation]; complaints are collected.
void read_all(ModelReading& reading);

/// The table `key` of the document, or an empty one; complains if it is something else.
const Table& section(ModelReading& reading, std::string_view key);

/// Names of things consist of letters, digits, _ and -. Complains if this name does not.
void check_name(ModelReading& reading, const Entry& entry, const std::string& path);

/// The marker that `text` names: "crank.A". If there is none, complains with `node` as the place.
MarkerRef read_marker_ref(ModelReading& reading, const Node& node, const std::string& path);

/// The two markers of `between`; they must be on different bodies. `thing` is what connects them, for the message.
void read_between(ModelReading& reading, const Record& record, const std::string& thing, MarkerRef& first,
                  MarkerRef& second);

}  // namespace pintle
