#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdio>
// jpeglib.h needs the two above.
#include <jpeglib.h>

namespace facemap {

/// Errors of libjpeg jump back to where setjmp(jump) stood, with their reason in `reason`; so functions that call
/// setjmp hold nothing with a destructor. Warnings that mean wrong pixels are errors, others are ignored.
struct JpegErrors {
  jpeg_error_mgr manager;  ///< first: libjpeg knows its address
  std::jmp_buf jump;
  char reason[JMSG_LENGTH_MAX];

  /// To be set as the `err` of a codec.
  jpeg_error_mgr* install();

  /// Jumps.
  [[noreturn]] static void fail(j_common_ptr codec, const char* reason);
};

}  // namespace facemap
