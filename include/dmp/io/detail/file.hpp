#pragma once
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <fcntl.h>
#include <unistd.h>

namespace dmp::io {

/// A file could not be written: no permission, disk full, folder gone. The text names the file and the system's reason.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {

[[nodiscard]] inline std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }
[[nodiscard]] inline std::string reason(int system_error) { return std::generic_category().message(system_error); }
[[noreturn]] inline void cannot_write(const std::filesystem::path& path, int system_error) {
  throw WriteError("io: cannot write " + quoted(path) + ": " + reason(system_error));
}

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

/// A file being written, from its beginning. Whatever fails, now or when buffered bytes reach the disk, is a WriteError.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
    if (!file_) cannot_write(path_, errno);
  }

  void write(const void* bytes, std::size_t size) {
    if (size > 0 && std::fwrite(bytes, 1, size, file_.get()) != size) cannot_write(path_, errno);
  }
  void write(std::string_view text) { write(text.data(), text.size()); }
  void flush() {
    if (std::fflush(file_.get()) != 0) cannot_write(path_, errno);
  }
  /// Until this returns, a power failure may lose what was written.
  void flush_to_disk() {
    flush();
    if (::fsync(::fileno(file_.get())) != 0 && errno != EINVAL && errno != ENOTSUP) cannot_write(path_, errno);
  }
  void close() {
    if (std::fclose(file_.release()) != 0) cannot_write(path_, errno);
  }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// A file that is there whole or not at all: written beside its place as "<path>.part" and moved there by commit(). Until then a
/// former file of that name stays; without commit() the part is removed.
class WholeFile {
 public:
  explicit WholeFile(std::filesystem::path path) : path_(std::move(path)), part_(checked_part_of(path_)) {}
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  ~WholeFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(part_.path(), ignored);
  }

  void write(const void* bytes, std::size_t size) { part_.write(bytes, size); }
  void write(std::string_view text) { part_.write(text); }
  void commit() {
    part_.flush();
    move_into_place();
  }
  /// As commit(), and a power failure leaves either the former file or this one.
  void commit_to_disk() {
    part_.flush_to_disk();
    move_into_place();
    const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    if (const int descriptor = ::open(folder.c_str(), O_RDONLY); descriptor >= 0) {
      ::fsync(descriptor);
      ::close(descriptor);
    }
  }

 private:
  /// Renaming over a device (/dev/null, /dev/full) would replace the device.
  static std::filesystem::path checked_part_of(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
      throw WriteError("io: cannot write " + quoted(path) + ": it exists and is not a regular file");
    return path.string() + ".part";
  }
  void move_into_place() {
    part_.close();
    std::error_code error;
    std::filesystem::rename(part_.path(), path_, error);
    if (error) cannot_write(path_, error.value());
    committed_ = true;
  }

  std::filesystem::path path_;
  OutputFile part_;
  bool committed_ = false;
};

}  // namespace detail
}  // namespace dmp::io
