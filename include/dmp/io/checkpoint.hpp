#pragma once
#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>
#include <dmp/io/detail/crc32.hpp>
#include <dmp/io/detail/file.hpp>

/// Checkpoints: named arrays in a file, bit for bit, so that a restarted run continues as if it had never stopped. In the file:
///   start    magic (8 bytes), byte-order mark, format version, length of the signature, signature, CRC of all after the magic
///   section  mark 1, length of the name, element size, number of elements, name, CRC of this; the bytes of the elements, their CRC
///   end      mark 2, number of sections, size of the file, CRC of this
/// Marks, version and CRCs (CRC-32) are 32-bit, lengths and numbers 64-bit unsigned integers in the byte order of the machine.
namespace dmp::io {

/// A checkpoint cannot be written, or cannot be trusted. The text names the file and what is wrong with it.
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {

inline constexpr std::string_view checkpoint_magic = "\x89" "dmpckp\n";
inline constexpr std::uint32_t checkpoint_byte_order = 0x01020304, swapped_byte_order = 0x04030201, checkpoint_version = 2;
inline constexpr std::uint32_t section_mark = 1, end_mark = 2;

[[noreturn]] inline void reject_checkpoint(const std::filesystem::path& path, const std::string& what) {
  throw CheckpointError("io::checkpoint: " + quoted(path) + ": " + what);
}

/// A record made of numbers and text, closed by its CRC.
class Record {
 public:
  template <class T>
    requires std::is_integral_v<T>
  Record& operator<<(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Record& operator<<(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  [[nodiscard]] std::string closed() && {
    *this << crc32(bytes_.data(), bytes_.size());
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace detail

/// Writes a checkpoint beside its place (<path>.part) and puts it there with commit(): a run that is killed before leaves the former
/// checkpoint as it was, and perhaps that part, which the next one overwrites. `signature` says what scene this is (names, parameters,
/// fields); only a reader with the same one accepts it.
///   CheckpointWriter checkpoint(results / "checkpoint", signature);   checkpoint.add("position", x);   checkpoint.commit();
class CheckpointWriter {
 public:
  CheckpointWriter(std::filesystem::path path, std::string_view signature) : path_(std::move(path)) {
    guarded([&] {
      file_ = std::make_unique<detail::WholeFile>(path_);
      detail::Record start;
      start << detail::checkpoint_byte_order << detail::checkpoint_version << std::uint64_t{signature.size()} << signature;
      write(detail::checkpoint_magic);
      write(std::move(start).closed());
    });
  }

  /// Adds a section from contiguous elements of a trivially copyable type: a vector, array or span of numbers. Names must differ.
  template <class Range>
  void add(std::string_view name, const Range& values) {
    const std::span elements(values);
    using Element = typename decltype(elements)::value_type;
    static_assert(std::is_trivially_copyable_v<Element>, "dmp: a checkpoint holds trivially copyable elements: numbers or structs of them");
    add_bytes(name, elements.data(), sizeof(Element), elements.size());
  }

  /// Completes the file and puts it in place of the former one, also against a power failure. Nothing can be added after it.
  void commit() {
    require_open("commit");
    const std::uint64_t mark_to_crc = 2 * sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t);
    detail::Record end;
    end << detail::end_mark << std::uint64_t{names_.size()} << size_ + mark_to_crc;
    guarded([&] {
      write(std::move(end).closed());
      file_->commit_to_disk();
    });
    file_.reset();
  }

 private:
  void add_bytes(std::string_view name, const void* data, std::size_t element_size, std::size_t count) {
    require_open("add section '" + std::string(name) + "'");
    for (const std::string& known : names_)
      if (known == name) detail::reject_checkpoint(path_, "section '" + std::string(name) + "' is added twice");
    names_.emplace_back(name);
    const std::size_t bytes = element_size * count;
    detail::Record section;
    section << detail::section_mark << std::uint64_t{name.size()} << std::uint64_t{element_size} << std::uint64_t{count} << name;
    const std::uint32_t crc = detail::crc32(data, bytes);
    guarded([&] {
      write(std::move(section).closed());
      write({static_cast<const char*>(data), bytes});
      write({reinterpret_cast<const char*>(&crc), sizeof crc});
    });
  }
  void require_open(const std::string& what) const {
    if (!file_) detail::reject_checkpoint(path_, "cannot " + what + " after commit or a failure");
  }
  void write(std::string_view bytes) {
    file_->write(bytes);
    size_ += bytes.size();
  }
  template <class Function>
  void guarded(Function function) {
    try {
      function();
    } catch (const WriteError& failure) {
      file_.reset();
      detail::reject_checkpoint(path_, failure.what());
    }
  }

  std::filesystem::path path_;
  std::unique_ptr<detail::WholeFile> file_;
  std::vector<std::string> names_;
  std::uint64_t size_ = 0;
};

/// Reads a checkpoint whole and verifies all of it, before any of it is used.
///   const CheckpointReader checkpoint(results / "checkpoint", signature);   auto x = checkpoint.read<double>("position");
class CheckpointReader {
 public:
  CheckpointReader(std::filesystem::path path, std::string_view signature) : path_(std::move(path)) {
    load();
    verify_start(signature);
    while (verify_section()) {
    }
  }

  /// The elements of a section. T must have the size of the elements written; that it is the same type is up to you.
  template <class T>
    requires std::is_trivially_copyable_v<T>
  [[nodiscard]] std::vector<T> read(std::string_view name) const {
    const Section* section = find(name);
    if (section == nullptr) reject("has no section '" + std::string(name) + "'; it has " + names());
    if (section->element_size != sizeof(T))
      reject("section '" + std::string(name) + "' has elements of " + std::to_string(section->element_size) +
             " bytes, asked for elements of " + std::to_string(sizeof(T)));
    std::vector<T> values(section->count);
    if (section->count > 0) std::memcpy(values.data(), section->data, section->count * sizeof(T));
    return values;
  }
  [[nodiscard]] bool contains(std::string_view name) const noexcept { return find(name) != nullptr; }

 private:
  struct Section {
    std::string name;
    std::size_t element_size, count;
    const char* data;
  };

  [[noreturn]] void reject(const std::string& what) const { detail::reject_checkpoint(path_, what); }

  void load() {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path_, error);  // before opening, which would wait for the writer of a pipe
    if (error) reject("cannot open: " + error.message());
    errno = 0;
    const std::unique_ptr<std::FILE, detail::Close> file(std::fopen(path_.c_str(), "rb"));
    if (!file) reject("cannot open: " + detail::reason(errno));
    const auto read = [&](std::size_t wanted) {
      const std::size_t before = bytes_.size(), more = wanted - before;
      bytes_.resize(wanted);
      if (std::fread(bytes_.data() + before, 1, more, file.get()) != more) reject("cannot read: " + detail::reason(errno));
    };
    const std::string_view magic = detail::checkpoint_magic;
    read(std::min(static_cast<std::size_t>(size), magic.size()));
    if (std::string_view(bytes_.data(), bytes_.size()) != magic.substr(0, bytes_.size())) reject("is not a checkpoint");
    read(static_cast<std::size_t>(size));  // some other large file has not got here
  }

  /// The next `size` bytes. Lengths from the file come here before they are used for anything.
  const char* take(std::uint64_t size) {
    if (size > bytes_.size() - position_) reject("truncated or damaged: ends after " + std::to_string(bytes_.size()) + " bytes");
    const char* const begin = bytes_.data() + position_;
    position_ += static_cast<std::size_t>(size);
    return begin;
  }
  template <class T>
  T take_number() {
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  void verify_crc(std::size_t begin, const std::string& of) {
    const std::uint32_t actual = detail::crc32(bytes_.data() + begin, position_ - begin);
    if (take_number<std::uint32_t>() != actual) reject("damaged: CRC of " + of + " does not match");
  }

  void verify_start(std::string_view signature) {
    take(detail::checkpoint_magic.size());
    const std::size_t begin = position_;
    const auto byte_order = take_number<std::uint32_t>();
    if (byte_order == detail::swapped_byte_order) reject("was written on a machine of the other byte order");
    if (byte_order != detail::checkpoint_byte_order) reject("damaged: its byte-order mark is none");
    const auto version = take_number<std::uint32_t>();
    if (version != detail::checkpoint_version)
      reject("has format version " + std::to_string(version) + ", this program reads version " +
             std::to_string(detail::checkpoint_version));
    const auto length = take_number<std::uint64_t>();
    const std::string_view found(take(length), static_cast<std::size_t>(length));
    verify_crc(begin, "the start");
    if (found != signature)
      reject("is the checkpoint of another scene: its signature is '" + std::string(found) + "', expected '" + std::string(signature) +
             "'");
  }

  /// False when this was the end.
  bool verify_section() {
    const std::size_t begin = position_;
    const auto mark = take_number<std::uint32_t>();
    if (mark == detail::end_mark) {
      const auto sections = take_number<std::uint64_t>();
      const auto size = take_number<std::uint64_t>();
      verify_crc(begin, "the end");
      if (sections != sections_.size() || size != bytes_.size() || position_ != bytes_.size())
        reject("damaged: must have " + std::to_string(sections) + " sections and " + std::to_string(size) + " bytes, has " +
               std::to_string(sections_.size()) + " and " + std::to_string(bytes_.size()));
      return false;
    }
    if (mark != detail::section_mark)
      reject("damaged: after " + std::to_string(sections_.size()) + " sections comes neither a section nor the end");
    const auto name_length = take_number<std::uint64_t>();
    const auto element_size = take_number<std::uint64_t>();
    const auto count = take_number<std::uint64_t>();
    const std::string name(take(name_length), static_cast<std::size_t>(name_length));
    verify_crc(begin, "the header of section " + std::to_string(sections_.size() + 1));
    if (element_size == 0) reject("damaged: section '" + name + "' has elements of no size");
    if (count > std::numeric_limits<std::uint64_t>::max() / element_size) reject("damaged: section '" + name + "' is longer than any file");
    const std::size_t data_begin = position_;
    const char* const data = take(element_size * count);
    verify_crc(data_begin, "section '" + name + "'");
    sections_.push_back({name, static_cast<std::size_t>(element_size), static_cast<std::size_t>(count), data});
    return true;
  }

  [[nodiscard]] const Section* find(std::string_view name) const noexcept {
    for (const Section& section : sections_)
      if (section.name == name) return &section;
    return nullptr;
  }
  [[nodiscard]] std::string names() const {
    std::string text;
    for (const Section& section : sections_) text += (text.empty() ? "'" : ", '") + section.name + "'";
    return text.empty() ? "none" : text;
  }

  std::filesystem::path path_;
  std::vector<char> bytes_;
  std::size_t position_ = 0;
  std::vector<Section> sections_;
};

}  // namespace dmp::io
