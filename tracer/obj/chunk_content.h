// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tracer/base/scratch_array.h"
#include "tracer/obj/obj_chunk.h"

namespace tracer {

/// An array that is filled from the front and never grows: who fills it knows how much may come.
template <class T>
class Filled {
 public:
  /// Room for `capacity` elements, and none in it.
  void reset(size_t capacity) {
    if (capacity > capacity_) {
      elements_ = ScratchArray<T>(capacity);
      capacity_ = capacity;
    }
    size_ = 0;
  }
  void push(const T& element) { elements_[size_++] = element; }
  /// The room behind the last element, which keep() makes elements of.
  T* free_room() { return elements_.data() + size_; }
  void keep(size_t count) { size_ += count; }
  void drop_back_to(size_t size) { size_ = size; }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& back() { return elements_[size_ - 1]; }
  std::span<T> elements() { return {elements_.data(), size_}; }
  std::span<const T> elements() const { return {elements_.data(), size_}; }

 private:
  ScratchArray<T> elements_;
  size_t capacity_ = 0;
  size_t size_ = 0;
};

/// Where the arrays of a file's chunks are: apart are those that are let go one after the other.
struct ChunkMemory {
  PageArena positions;
  PageArena attributes;
  PageArena faces;
};

/// A chunk's vertices and faces while it is parsed: one thread uses the same memory for all chunks.
class ChunkContent {
 public:
  /// Makes room for what `text_bytes` bytes can say.
  void reset(size_t text_bytes);

  void push_position(const Vec3d& position) { positions.push(position); }
  void push_color(const Vec3f& color);
  /// NaN for the last position, if any has a colour.
  void push_no_color() {
    if (!colors_.empty()) push_nan_color();
  }

  /// Adds the face whose indices are the last of `indices`.
  void add_face(uint32_t corner_count, CornerForm form, uint32_t material, uint32_t line);

  /// Takes them, and their indices, out of all that has been added.
  void drop_texcoords();

  /// Exact copies of all arrays, and what can be said of them.
  void copy_to(ObjChunk& chunk, ChunkMemory& memory) const;

  Filled<Vec3d> positions;
  Filled<Vec2f> texcoords;
  Filled<Vec3f> normals;
  Filled<int32_t> indices;

 private:
  void push_nan_color();
  void add_run(uint32_t corner_count, CornerForm form, uint32_t material, uint32_t line);

  Filled<Vec3f> colors_;
  Filled<FaceRun> runs_;
};

inline void ChunkContent::add_face(uint32_t corner_count, CornerForm form, uint32_t material,
                                   uint32_t line) {
  // What stands between two faces takes a line, be it a vertex or another material.
  if (!runs_.empty()) {
    FaceRun& run = runs_.back();
    if (run.line + run.face_count == line && run.corner_count == corner_count && run.form == form) {
      ++run.face_count;
      return;
    }
  }
  add_run(corner_count, form, material, line);
}

}  // namespace tracer
