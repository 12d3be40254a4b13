#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// An archive in the format ustar (POSIX.1-1988), made in memory.
class TarArchive final
{
    std::string _bytes;

public:
    /// A regular file, mode 0600. The name is a relative path of at most 100 bytes; the time is in seconds since 1970.
    void Add(std::string_view name, std::string_view content, std::int64_t modifiedAt);

    /// The archive with its end.
    [[nodiscard]] std::string Finish() const;
};

/// The bytes in the format gzip (RFC 1952).
[[nodiscard]] std::string CompressGzip(std::string_view bytes);

} // namespace ACS::Acsctl
