// Makes a film from frames with the program ffmpeg.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "cli/pictures/raster.h"
#include "results/disk.h"

namespace pintle::cli {

enum class FilmForm { kGif, kWebm };

/// Frames are piped to ffmpeg, which writes to a temporary file; finish() renames it. If destroyed before that, it
/// leaves no trace.
class FilmEncoder {
 public:
  /// The first `n_samples` frames only supply colours for a GIF's palette. Throws FileError if there is no ffmpeg.
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
  bool wait();  ///< true: ffmpeg succeeded

  Replacement file_;
  pid_t process_ = -1;
  int frames_ = -1, complaints_ = -1;
  int ended_by_ = 0;  // the signal that ended ffmpeg, if one did
};

}  // namespace pintle::cli
