// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_obj.h"

#include <deque>
#include <mutex>

#include "tracer/base/brief_mutex.h"
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
                Texcoords texcoords, const ObjLimits& limits, Progress& progress)
      : source_(source),
        path_(path),
        texcoords_(texcoords),
        limits_(limits),
        progress_(progress),
        reader_(source, chunk_bytes) {}

  std::deque<ObjChunk> parse() {
    if (texcoords_ == Texcoords::dropped) parse_begin();
    parallel_workers([&] { work(); });
    progress_.throw_if_stopped();
    progress_.set_fraction(1);
    return std::move(chunks_);
  }

 private:
  /// Exporters name the material library first.
  void parse_begin() {
    TextBlock block;
    ChunkContent content;
    size_t index = 0;
    if (!take(block, index)) return;
    ObjChunk chunk = parse_obj_chunk(block, content, Texcoords::kept, memory_);
    if (!chunk.material_libraries.empty()) texcoords_ = Texcoords::kept;
    put(std::move(chunk), index);
  }

  void work() {
    TextBlock block;
    ChunkContent content;
    for (size_t index = 0; take(block, index);) {
      put(parse_obj_chunk(block, content, texcoords_, memory_), index);
    }
  }

  bool take(TextBlock& block, size_t& index) {
    const std::lock_guard lock(reader_mutex_);
    progress_.throw_if_stopped();
    if (!reader_.next(block)) return false;
    index = block_count_++;
    progress_.set_fraction(source_.fraction());
    return true;
  }

  void put(ObjChunk&& chunk, size_t index) {
    const std::lock_guard lock(chunks_mutex_);
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

  ByteSource& source_;
  const std::string& path_;
  Texcoords texcoords_;
  const ObjLimits& limits_;
  Progress& progress_;
  ChunkMemory memory_;

  BriefMutex reader_mutex_;
  StatementReader reader_;
  size_t block_count_ = 0;

  BriefMutex chunks_mutex_;
  std::deque<ObjChunk> chunks_;  // which stay where they are as more come
  ObjCounts totals_;
  uint64_t corner_count_ = 0;
  uint64_t triangle_count_ = 0;
};

ObjFile parse_source(ByteSource& source, const std::string& path, size_t chunk_bytes,
                     Texcoords texcoords, const ObjLimits& limits, Progress& progress) {
  progress.start_stage("reading");
  ChunkedParser parser(source, path, chunk_bytes, texcoords, limits, progress);
  return join_chunks(parser.parse(), path, progress);
}

}  // namespace

ObjFile parse_obj_in_chunks(std::string_view bytes, const std::string& path, size_t chunk_bytes,
                            Progress& progress, Texcoords texcoords) {
  MemorySource source(bytes);
  return parse_source(source, path, chunk_bytes, texcoords, {}, progress);
}

ObjFile parse_obj(std::string_view bytes, const std::string& path, Progress& progress,
                  Texcoords texcoords) {
  return parse_obj_in_chunks(bytes, path, usual_chunk_bytes, progress, texcoords);
}

ObjFile parse_obj(ByteSource& source, const std::string& path, Progress& progress,
                  Texcoords texcoords, const ObjLimits& limits) {
  return parse_source(source, path, usual_chunk_bytes, texcoords, limits, progress);
}

}  // namespace tracer
