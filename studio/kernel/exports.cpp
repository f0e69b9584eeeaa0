// The functions of the WebAssembly module. The caller writes name and arguments into memory from `malloc`, and reads the
// answer before the next call.
#include <cstdint>
#include <string>

#include "studio/kernel/calls.h"

#define PINTLE_EXPORT(name) __attribute__((export_name(#name))) name
#define PINTLE_IMPORT(name) __attribute__((import_module("env"), import_name(#name))) name

extern "C" {
/// Takes progress as JSON; 0 ends the run.
int PINTLE_IMPORT(pintle_progress)(const char* text, std::size_t size);
}

namespace {

pintle::studio::Kernel& kernel() {
  static pintle::studio::Kernel the_kernel;
  return the_kernel;
}

pintle::studio::Answer& answer() {
  static pintle::studio::Answer last;
  return last;
}

}  // namespace

extern "C" {

/// The number of arrays in the answer.
std::size_t PINTLE_EXPORT(pintle_call)(const char* name, std::size_t name_size, const char* arguments, std::size_t arguments_size) {
  answer() = {};
  answer() = kernel().call({name, name_size}, {arguments, arguments_size},
                           [](std::string_view text) { return pintle_progress(text.data(), text.size()) != 0; });
  return answer().arrays.size();
}
const char* PINTLE_EXPORT(pintle_text)() { return answer().text.data(); }
std::size_t PINTLE_EXPORT(pintle_text_size)() { return answer().text.size(); }
const double* PINTLE_EXPORT(pintle_array)(std::size_t i) { return answer().arrays[i].data(); }
std::size_t PINTLE_EXPORT(pintle_array_size)(std::size_t i) { return answer().arrays[i].size(); }
void PINTLE_EXPORT(pintle_forget)() { answer() = {}; }

}  // extern "C"
