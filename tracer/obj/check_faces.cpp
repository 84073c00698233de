// SPDX-License-Identifier: MIT
#include "tracer/obj/check_faces.h"

#include <string>

namespace tracer {
namespace {

/// One kind of index: how many there are before a run, and in the whole file.
struct Kind {
  const char* name;
  uint64_t defined_count;
  uint64_t total_count;
};

/// From 1; 0 where there is no such element.
uint64_t resolve(int32_t written, const Kind& kind) {
  if (written < 0) {
    const auto back = static_cast<uint64_t>(-static_cast<int64_t>(written));
    return back > kind.defined_count ? 0 : kind.defined_count - back + 1;
  }
  return static_cast<uint64_t>(written) > kind.total_count ? 0 : static_cast<uint64_t>(written);
}

std::string missing(int32_t written, const Kind& kind) {
  const std::string there = written < 0 ? std::to_string(kind.defined_count) + " so far"
                                        : "the file has " + std::to_string(kind.total_count);
  return std::string(kind.name) + ' ' + std::to_string(written) + " does not exist (" + there + ')';
}

class FaceChecker {
 public:
  FaceChecker(ObjChunk& chunk, const ObjCounts& before, const ObjCounts& total)
      : chunk_(chunk), before_(before), total_(total) {}

  Warnings check() {
    for (const FaceRun& run : chunk_.runs) check_run(run);
    return std::move(warnings_);
  }

 private:
  void check_run(const FaceRun& run) {
    const uint32_t stride = indices_a_corner(run.form);
    const Kind positions{"vertex", before_.positions + run.position_count, total_.positions};
    const Kind texcoords{"texture coordinate", before_.texcoords + run.texcoord_count,
                         total_.texcoords};
    const Kind normals{"normal", before_.normals + run.normal_count, total_.normals};
    int32_t* face = chunk_.indices.data() + run.first_index;
    for (uint32_t i = 0; i < run.face_count; ++i, face += run.indices_a_face()) {
      const uint32_t line = run.line + i;
      if (resolve_all(face, run.corner_count, stride, positions, line) == Found::some_missing) {
        drop(face);
        continue;
      }
      if (has_texcoord(run.form)) {
        resolve_all(face + 1, run.corner_count, stride, texcoords, line);
      }
      if (has_normal(run.form)) {
        resolve_all(face + stride - 1, run.corner_count, stride, normals, line);
      }
    }
  }

  enum class Found { all, some_missing };

  /// One message a face is enough.
  Found resolve_all(int32_t* indices, uint32_t count, uint32_t stride, const Kind& kind,
                    uint32_t line) {
    Found found = Found::all;
    for (uint32_t i = 0; i < count; ++i, indices += stride) {
      const int32_t written = *indices;
      *indices = static_cast<int32_t>(resolve(written, kind));
      if (written == 0 || *indices != 0 || found == Found::some_missing) continue;
      found = Found::some_missing;
      warnings_.add({"", line, missing(written, kind)});
    }
    return found;
  }

  void drop(int32_t* face) {
    *face = 0;
    --chunk_.face_count;
    ++chunk_.dropped_faces;
  }

  ObjChunk& chunk_;
  const ObjCounts before_;
  const ObjCounts total_;
  Warnings warnings_;
};

}  // namespace

Warnings check_faces(ObjChunk& chunk, const ObjCounts& before, const ObjCounts& total) {
  const LargestIndices& largest = chunk.largest;
  const bool is_all_there = largest.position <= total.positions &&
                            largest.texcoord <= total.texcoords && largest.normal <= total.normals;
  return is_all_there ? Warnings() : FaceChecker(chunk, before, total).check();
}

}  // namespace tracer
