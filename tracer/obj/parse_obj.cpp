// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_obj.h"

#include <mutex>

#include "tracer/base/parallel.h"
#include "tracer/obj/join_chunks.h"
#include "tracer/obj/parse_chunk.h"

namespace tracer {
namespace {

// Text and what it says stay in a core's cache until they are copied.
constexpr size_t usual_chunk_bytes = size_t{1} << 17;

/// What all threads share: blocks are taken in the file's order, chunks come back in any.
class ChunkedParser {
 public:
  ChunkedParser(ByteSource& source, const std::string& path, size_t chunk_bytes,
                const ObjLimits& limits, Progress& progress)
      : reader_(source, chunk_bytes),
        source_(source),
        path_(path),
        limits_(limits),
        progress_(progress) {}

  std::vector<ObjChunk> parse() {
    parallel_workers([&] { work(); });
    progress_.throw_if_stopped();
    progress_.set_fraction(1);
    return std::move(chunks_);
  }

 private:
  void work() {
    TextBlock block;
    ChunkContent content;
    for (size_t index = 0; take(block, index);) {
      put(parse_obj_chunk(block, content, memory_), index);
    }
  }

  bool take(TextBlock& block, size_t& index) {
    const std::lock_guard lock(mutex_);
    progress_.throw_if_stopped();
    if (!reader_.next(block)) return false;
    index = block_count_++;
    progress_.set_fraction(source_.fraction());
    return true;
  }

  void put(ObjChunk&& chunk, size_t index) {
    const std::lock_guard lock(mutex_);
    const ObjCounts counts = chunk.counts();
    add(totals_.positions, counts.positions, limits_.vertices, "vertices");
    add(totals_.texcoords, counts.texcoords, limits_.vertices, "texture coordinates");
    add(totals_.normals, counts.normals, limits_.vertices, "normals");
    add(corner_count_, chunk.corner_count, limits_.corners, "face corners");
    add(triangle_count_, chunk.triangle_count, limits_.triangles, "triangles");
    if (index >= chunks_.size()) chunks_.resize(index + 1);
    chunks_[index] = std::move(chunk);
  }

  void add(uint64_t& total, uint64_t more, uint64_t limit, const char* what) const {
    total += more;
    if (total <= limit) return;
    throw LoadError({path_, 0,
                     "the file has more than " + std::to_string(limit) + ' ' + what +
                         ", which 32-bit indices cannot count"});
  }

  ChunkMemory memory_;
  std::mutex mutex_;
  StatementReader reader_;
  ByteSource& source_;
  const std::string& path_;
  const ObjLimits& limits_;
  Progress& progress_;
  std::vector<ObjChunk> chunks_;
  size_t block_count_ = 0;
  ObjCounts totals_;
  uint64_t corner_count_ = 0;
  uint64_t triangle_count_ = 0;
};

ObjFile parse_source(ByteSource& source, const std::string& path, size_t chunk_bytes,
                     const ObjLimits& limits, Progress& progress) {
  progress.start_stage("reading");
  return join_chunks(ChunkedParser(source, path, chunk_bytes, limits, progress).parse(), path,
                     progress);
}

}  // namespace

ObjFile parse_obj_in_chunks(std::string_view bytes, const std::string& path, size_t chunk_bytes,
                            Progress& progress) {
  MemorySource source(bytes);
  return parse_source(source, path, chunk_bytes, {}, progress);
}

ObjFile parse_obj(std::string_view bytes, const std::string& path, Progress& progress) {
  return parse_obj_in_chunks(bytes, path, usual_chunk_bytes, progress);
}

ObjFile parse_obj(ByteSource& source, const std::string& path, Progress& progress,
                  const ObjLimits& limits) {
  return parse_source(source, path, usual_chunk_bytes, limits, progress);
}

}  // namespace tracer
