// Functions that the page brings, so that the linker knows them.
mergeInto(LibraryManager.library, {
  pintle_progress: function (text, size) {},
});
