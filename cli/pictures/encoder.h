// A film from frames, by the program ffmpeg.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "cli/pictures/raster.h"
#include "results/disk.h"

namespace pintle::cli {

enum class FilmForm { kGif, kWebm };

/// Frames go through a pipe into ffmpeg, which writes beside the film; finish() renames. Destroyed before that, it leaves
/// no trace.
class FilmEncoder {
 public:
  /// The first `n_samples` frames only show the colours, for a GIF's palette. Throws FileError where there is no ffmpeg.
  FilmEncoder(const std::filesystem::path& film, FilmForm form, int width, int height, double frames_per_second, int n_samples);
  FilmEncoder(const FilmEncoder&) = delete;
  FilmEncoder& operator=(const FilmEncoder&) = delete;
  ~FilmEncoder();

  void add(const Pixels& frame);
  /// False: interrupted.
  bool finish();

 private:
  void start(const std::vector<std::string>& words);
  [[noreturn]] void fail();
  bool wait();  ///< true: ffmpeg ended well

  Replacement file_;
  pid_t process_ = -1;
  int frames_ = -1, complaints_ = -1;
  int ended_by_ = 0;  // the signal that ended ffmpeg, if one did
};

}  // namespace pintle::cli
