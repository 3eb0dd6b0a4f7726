#include "app/picture/exr_output.h"

#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>
#include <utility>

#include "app/base/error.h"
#include "app/base/message.h"

namespace trisect {
namespace {

// Rows of a band: several of the sixteen that OpenEXR compresses together.
constexpr uint32_t kRows = 64;

// OpenEXR's own stream does not do: the last that is written of a file, where its rows are, is
// written by a destructor, which keeps to itself that it could not.
class ExrStream : public Imf::OStream {
 public:
  explicit ExrStream(const AtomicFile& file)
      : OStream(file.target().c_str()), file_(std::fopen(file.temporary().c_str(), "wb")) {
    check(file_ != nullptr);
  }
  ~ExrStream() override {
    if (file_ != nullptr) std::fclose(file_);
  }
  ExrStream(const ExrStream&) = delete;
  ExrStream& operator=(const ExrStream&) = delete;
  ExrStream(ExrStream&&) = delete;
  ExrStream& operator=(ExrStream&&) = delete;

  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): OpenEXR's
  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    check(std::fwrite(bytes, 1, size, file_) == size);
  }
  uint64_t tellp() override {
    const off_t at = ftello(file_);
    check(at >= 0);
    return static_cast<uint64_t>(at);
  }
  void seekp(uint64_t at) override { check(fseeko(file_, static_cast<off_t>(at), SEEK_SET) == 0); }

  // After the last byte. Throws what was thrown before, or what closing the file comes to.
  void close() {
    const int closed = std::fclose(std::exchange(file_, nullptr));
    if (failure_) std::rethrow_exception(failure_);
    check(closed == 0);
  }

 private:
  void check(bool is_done) {
    if (is_done) return;
    if (!failure_) {
      failure_ = std::make_exception_ptr(std::system_error(errno, std::generic_category()));
    }
    std::rethrow_exception(failure_);
  }

  std::FILE* file_;
  std::exception_ptr failure_;  // the first one
};

}  // namespace

void write_exr_rows(const Imf::Header& header, const ExrRows& rows, const AtomicFile& file) {
  const Imath::Box2i& window = header.dataWindow();
  const auto height = static_cast<uint32_t>(window.max.y - window.min.y + 1);
  try {
    ExrStream stream(file);
    {
      Imf::OutputFile out(stream, header);
      for (uint32_t first = 0; first < height; first += kRows) {
        const uint32_t count = std::min(kRows, height - first);
        out.setFrameBuffer(rows(first, count));
        out.writePixels(static_cast<int>(count));
      }
    }
    stream.close();
  } catch (const std::exception& error) {
    if (is_told_as_it_is(error)) throw;
    throw InputError(fmt::format("{}: could not be written: {}.", file.target().string(),
                                 reason_of(error.what())));
  }
}

}  // namespace trisect
