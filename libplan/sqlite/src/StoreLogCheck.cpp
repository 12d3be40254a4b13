#include "StoreLogCheck.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

using Bytes = std::span<const unsigned char>;

constexpr std::size_t HEADER_SIZE = 32;
constexpr std::size_t FRAME_HEADER_SIZE = 24;
constexpr std::size_t SALTS_SIZE = 8;
/// Commits after the first invalid frame that a crash can leave: that of the transaction that was being written.
constexpr std::size_t MOST_UNFINISHED = 1;

std::uint32_t ReadNumber(Bytes bytes, std::size_t offset, bool bBigEndian = true)
{
    std::uint32_t number = 0;
    for (std::size_t index = 0; index < sizeof(number); ++index)
    {
        number = (number << 8U) | bytes[offset + (bBigEndian ? index : sizeof(number) - 1 - index)];
    }
    return number;
}

/// The checksum of the log's format: over pairs of words, continued from frame to frame.
struct Checksum
{
    std::uint32_t first = 0;
    std::uint32_t second = 0;

    bool operator==(const Checksum&) const = default;

    void Add(Bytes bytes, bool bBigEndian)
    {
        for (std::size_t offset = 0; offset + 2 * sizeof(first) <= bytes.size(); offset += 2 * sizeof(first))
        {
            first += ReadNumber(bytes, offset, bBigEndian) + second;
            second += ReadNumber(bytes, offset + sizeof(first), bBigEndian) + first;
        }
    }

    [[nodiscard]] static Checksum Read(Bytes bytes, std::size_t offset)
    {
        return {ReadNumber(bytes, offset), ReadNumber(bytes, offset + sizeof(first))};
    }
};

/// The header of a log: magic number, version, page size, sequence, salts, checksum.
struct LogHeader
{
    bool bBigEndian = false; ///< The words of the checksums.
    std::size_t pageSize = 0;
    std::vector<unsigned char> salts;
    Checksum checksum;
};

std::optional<LogHeader> ParseOrNull(Bytes bytes)
{
    constexpr std::uint32_t MAGIC = 0x377f0682; ///< With 1 added: big-endian words.
    constexpr std::size_t PAGE_SIZE_OFFSET = 8;
    constexpr std::size_t SALTS_OFFSET = 16;
    constexpr std::size_t CHECKSUM_OFFSET = 24;
    constexpr std::size_t SMALLEST_PAGE = 512;
    constexpr std::size_t LARGEST_PAGE = 65'536;
    const std::uint32_t magic = ReadNumber(bytes, 0);
    LogHeader header;
    header.bBigEndian = magic == MAGIC + 1;
    header.pageSize = ReadNumber(bytes, PAGE_SIZE_OFFSET);
    const Bytes salts = bytes.subspan(SALTS_OFFSET, SALTS_SIZE);
    header.salts.assign(salts.begin(), salts.end());
    header.checksum.Add(bytes.first(CHECKSUM_OFFSET), header.bBigEndian);
    const bool bValid = (magic == MAGIC || header.bBigEndian) && std::has_single_bit(header.pageSize)
        && header.pageSize >= SMALLEST_PAGE && header.pageSize <= LARGEST_PAGE
        && header.checksum == Checksum::Read(bytes, CHECKSUM_OFFSET);
    return bValid ? std::optional(std::move(header)) : std::nullopt;
}

bool TryRead(std::istream& in, std::vector<unsigned char>& bytes)
{
    std::vector<char> text(bytes.size());
    if (!in.read(text.data(), static_cast<std::streamsize>(text.size())))
    {
        return false;
    }
    bytes.assign(text.begin(), text.end());
    return true;
}

/// Commits of the log that follow its first invalid frame.
std::size_t CountLostCommits(std::istream& in, const LogHeader& header)
{
    constexpr std::size_t COMMIT_OFFSET = 4; ///< The size of the database after the commit; 0 in other frames.
    constexpr std::size_t SALTS_OFFSET = 8;
    constexpr std::size_t CHECKSUM_OFFSET = 16;
    Checksum checksum = header.checksum;
    bool bValid = true;
    std::size_t lost = 0;
    std::vector<unsigned char> frame(FRAME_HEADER_SIZE + header.pageSize);
    while (TryRead(in, frame))
    {
        const Bytes bytes(frame);
        const Bytes salts = bytes.subspan(SALTS_OFFSET, SALTS_SIZE);
        const bool bPresent = std::equal(salts.begin(), salts.end(), header.salts.begin()); // else of before a restart
        checksum.Add(bytes.first(SALTS_OFFSET), header.bBigEndian);
        checksum.Add(bytes.subspan(FRAME_HEADER_SIZE), header.bBigEndian);
        bValid = bValid && bPresent && checksum == Checksum::Read(bytes, CHECKSUM_OFFSET);
        lost += !bValid && bPresent && ReadNumber(bytes, COMMIT_OFFSET) != 0 ? 1U : 0U;
    }
    return lost;
}

} // namespace

bool IsLogDamaged(const std::string& log)
{
    std::ifstream in(log, std::ios::binary);
    if (!in.is_open())
    {
        return false;
    }
    std::vector<unsigned char> before(HEADER_SIZE);
    if (!TryRead(in, before))
    {
        return true;
    }
    const std::optional<LogHeader> headerOrNull = ParseOrNull(before);
    if (!headerOrNull.has_value())
    {
        return true;
    }
    in.seekg(0, std::ios::end);
    const bool bShort = static_cast<std::size_t>(in.tellg()) < HEADER_SIZE + FRAME_HEADER_SIZE + headerOrNull->pageSize;
    in.seekg(HEADER_SIZE);
    const bool bLost = bShort || CountLostCommits(in, *headerOrNull) > MOST_UNFINISHED;
    std::vector<unsigned char> after(HEADER_SIZE);
    in.clear();
    in.seekg(0);
    return bLost && TryRead(in, after) && after == before;
}

} // namespace ACS::Planning
