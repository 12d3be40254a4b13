#include <acs/json/DecodeContext.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Json
{

namespace
{

constexpr std::size_t PAIRWISE_LIMIT = 16;
constexpr std::size_t LONGEST_NAME = 64;

/// A member's name as a path shows it: a peer may send one of any length.
std::string ShortenName(std::string_view name)
{
    if (name.size() <= LONGEST_NAME)
    {
        return std::string(name);
    }
    std::size_t end = LONGEST_NAME;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U)
    {
        --end;
    }
    return std::string(name.substr(0, end)) + "...";
}

} // namespace

DecodeContext::DecodeContext(const DecodeOptions& options)
    : _options(options)
{
}

const DecodeOptions& DecodeContext::GetOptions() const noexcept
{
    return _options;
}

DecodeNotes& DecodeContext::GetNotes() noexcept
{
    return _notes;
}

const Core::Error& DecodeContext::GetError() const noexcept
{
    return _error;
}

Core::Error DecodeContext::TakeError()
{
    return std::exchange(_error, {});
}

bool DecodeContext::IsFailedWith(Core::ECoreError code, std::string expected, const Value* foundOrNull)
{
    return IsFailedWith(
        make_error_code(code),
        std::move(expected),
        foundOrNull == nullptr ? std::string() : ShortenForError(*foundOrNull));
}

bool DecodeContext::IsFailedWith(std::error_code code, std::string expected, std::string found)
{
    _error = Core::Error{code, {}, std::move(expected), std::move(found)};
    return false;
}

bool DecodeContext::IsFailedAt(std::string_view memberName)
{
    const bool bJoins = _error.path.empty() || _error.path.front() == '[';
    _error.path.insert(0, bJoins ? "" : ".");
    _error.path.insert(0, ShortenName(memberName));
    return false;
}

bool DecodeContext::IsFailedAt(std::size_t index)
{
    const bool bJoins = _error.path.empty() || _error.path.front() == '[';
    _error.path.insert(0, fmt::format("[{}]{}", index, bJoins ? "" : "."));
    return false;
}

bool DecodeContext::TryNoteUnknown(std::string_view name, const Value& value, std::size_t firstUnknown)
{
    if (_options.bUnknownMembersRefused)
    {
        static_cast<void>(
            IsFailedWith(make_error_code(Core::ECoreError::UnknownWord), "no such member", std::string()));
        return IsFailedAt(name);
    }
    const auto begin = _unknownNames.begin() + static_cast<std::ptrdiff_t>(firstUnknown);
    const std::size_t count = _unknownNames.size() - firstUnknown;
    // Few names are compared at once; many (a hostile message) are sorted once at the end, see TryForgetUnknown.
    if (count < PAIRWISE_LIMIT && std::find(begin, _unknownNames.end(), name) != _unknownNames.end())
    {
        return IsRepeatedMember(name, *this);
    }
    if ((value.IsObject() || value.IsArray()) && HasDuplicateNames(value))
    {
        return IsRepeatedMember(name, *this);
    }
    _unknownNames.push_back(name);
    ++_notes.unknownMembers;
    return true;
}

std::size_t DecodeContext::GetUnknownCount() const noexcept
{
    return _unknownNames.size();
}

bool DecodeContext::TryForgetUnknown(std::size_t firstUnknown)
{
    const auto begin = _unknownNames.begin() + static_cast<std::ptrdiff_t>(firstUnknown);
    if (_unknownNames.size() - firstUnknown > PAIRWISE_LIMIT)
    {
        std::sort(begin, _unknownNames.end());
        const auto repeated = std::adjacent_find(begin, _unknownNames.end());
        if (repeated != _unknownNames.end())
        {
            return IsRepeatedMember(*repeated, *this);
        }
    }
    _unknownNames.resize(firstUnknown);
    return true;
}

bool IsRepeatedMember(std::string_view name, DecodeContext& context)
{
    static_cast<void>(context.IsFailedWith(
        make_error_code(Core::ECoreError::InvalidJSON),
        "each member once",
        "a member named twice"));
    return context.IsFailedAt(name);
}

} // namespace ACS::Json
