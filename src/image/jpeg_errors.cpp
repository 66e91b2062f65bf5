#include "image/jpeg_errors.h"

#include <jerror.h>

#include <cstring>

namespace facemap {
namespace {

[[noreturn]] void jump_back(j_common_ptr codec) {
  if (codec->err->msg_code == JWRN_JPEG_EOF) JpegErrors::fail(codec, "it ends too early");
  char text[JMSG_LENGTH_MAX];
  codec->err->format_message(codec, text);
  JpegErrors::fail(codec, text);
}

/// `level` is -1 for a warning, 0 and more for traces.
void judge_message(j_common_ptr codec, int level) {
  if (level >= 0) return;
  switch (codec->err->msg_code) {
    case JWRN_JPEG_EOF:
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_MUST_RESYNC:
    case JWRN_NOT_SEQUENTIAL:
    case JWRN_BOGUS_PROGRESSION:
      jump_back(codec);
    default:
      break;
  }
}

void print_nothing(j_common_ptr) {}

}  // namespace

jpeg_error_mgr* JpegErrors::install() {
  jpeg_std_error(&manager);
  manager.error_exit = &jump_back;
  manager.emit_message = &judge_message;
  manager.output_message = &print_nothing;
  std::memset(reason, 0, sizeof reason);
  return &manager;
}

void JpegErrors::fail(j_common_ptr codec, const char* reason) {
  auto* const errors = reinterpret_cast<JpegErrors*>(codec->err);
  std::strncpy(errors->reason, reason, sizeof errors->reason - 1);
  std::longjmp(errors->jump, 1);
}

}  // namespace facemap
