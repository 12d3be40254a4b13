#pragma once

#include <acs/core/Result.hpp>
#include <acs/json/PoolMemory.hpp>

#include <rapidjson/document.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Json
{

using PoolAllocator = rapidjson::MemoryPoolAllocator<PoolMemory>;
using Document = rapidjson::GenericDocument<rapidjson::UTF8<>, PoolAllocator, PoolAllocator>;
using Value = Document::ValueType;

/// What a text may be at most. One place for these limits; each codec's options start from it.
struct ParseLimits
{
    std::size_t bytes = 4U * 1024U * 1024U; ///< Longest text.
    std::size_t depth = 64;                 ///< Deepest nesting of objects and arrays.
    std::size_t values = 250'000;           ///< Values of any kind, objects and arrays among them, at any depth.
};

/// Parses JSON text into RapidJSON's document: iterative (no stack overflow), encoding checked, full precision.
/// Works on a copy of the text, in which the strings of the document stay. Keeps its buffers between calls, so that a
/// message that fits allocates nothing. Throws std::bad_alloc. Not shared between threads.
class JsonDocument
{
    std::unique_ptr<char[]> _valueBuffer; // NOLINT(modernize-avoid-c-arrays)
    std::unique_ptr<char[]> _stackBuffer; // NOLINT(modernize-avoid-c-arrays)
    PoolAllocator _valuePool;
    PoolAllocator _stackPool;
    std::optional<Document> _document;

public:
    JsonDocument();
    JsonDocument(const JsonDocument&) = delete;
    JsonDocument& operator=(const JsonDocument&) = delete;
    ~JsonDocument();

    /// The value is valid until the next Parse. Errors: TooLarge, InvalidJSON (with byte or line). A limit ends the
    /// parse where it is exceeded. With bLenient,
    /// comments and commas behind the last member or element are read over.
    [[nodiscard]] Core::Result<const Value*> Parse(
        std::string_view text,
        const ParseLimits& limits,
        bool bLenient = false);
};

/// The first member of this name; nullptr where there is none, or a null, or no object.
[[nodiscard]] const Value* FindFirstOrNull(const Value& object, std::string_view name);

/// Compact text of a value, for errors: at most 40 bytes, cut at a character.
[[nodiscard]] std::string ShortenForError(const Value& value);

/// Compact JSON text of a value.
[[nodiscard]] std::string WriteText(const Value& value);

/// Whether any object in the value, at any depth, names a member twice.
[[nodiscard]] bool HasDuplicateNames(const Value& value);

} // namespace ACS::Json
