// Collects everything that is wrong with a document, with suggestions, and throws it together.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/document.h"

namespace pintle {

/// "did you mean ...?" if `near` is not empty, else "one of" the first of `names`.
std::string advice(const std::string& near, const std::vector<std::string>& names);

class Complaints {
 public:
  explicit Complaints(const Document& document) : document_(document) {}

  void add(Spot spot, std::string path, std::string found, std::string because, std::string suggestion = {});

  /// The candidate nearest to `word`, or "" if none is near. In big models with many mistakes only the first ones get
  /// this: each search compares the word with every candidate.
  std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

  /// The nearest candidate as a question, or a list of them.
  std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

  bool empty() const { return complaints_.empty(); }
  std::size_t size() const { return complaints_.size(); }
  const Document& document() const { return document_; }

  /// Throws InputError with all complaints in the order of the text, if there is any.
  void throw_if_any();

 private:
  const Document& document_;
  std::vector<std::pair<Spot, Complaint>> complaints_;
  int suggestions_left_ = 100;
};

}  // namespace pintle
