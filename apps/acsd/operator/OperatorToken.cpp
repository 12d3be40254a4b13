#include "operator/OperatorToken.hpp"

#include "common/config/WordReader.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/sha.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace ACS::Acsd
{

namespace
{

/// A look-up compares with each of them.
constexpr std::size_t MOST_TOKENS = 1'000;
constexpr std::size_t LONGEST_NAME = 64;
constexpr int HEXADECIMAL = 16;

bool IsNameCharacter(char character)
{
    const bool bAlphanumeric = (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z')
        || (character >= '0' && character <= '9');
    return bAlphanumeric || std::string_view("._-@").find(character) != std::string_view::npos;
}

std::optional<OperatorToken::Hash> ReadHashOrNull(std::string_view word)
{
    OperatorToken::Hash hash{};
    if (word.size() != 2 * hash.size())
    {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < hash.size(); ++i)
    {
        const std::string_view digits = word.substr(2 * i, 2);
        const char* const end = digits.data() + digits.size();
        const auto [parsed, error] = std::from_chars(digits.data(), end, hash.at(i), HEXADECIMAL);
        if (error != std::errc() || parsed != end)
        {
            return std::nullopt;
        }
    }
    return hash;
}

std::optional<OperatorToken> ReadTokenLineOrNull(std::string_view line)
{
    const std::optional<EOperatorRole> role = ReadRoleOrNull(Apps::TakeWord(line));
    const std::string_view name = Apps::TakeWord(line);
    const std::optional<OperatorToken::Hash> hash = ReadHashOrNull(Apps::TakeWord(line));
    if (!role.has_value() || !IsOperatorName(name) || !hash.has_value() || !Apps::TakeWord(line).empty())
    {
        return std::nullopt;
    }
    return OperatorToken{*role, std::string(name), *hash};
}

} // namespace

std::optional<EOperatorRole> ReadRoleOrNull(std::string_view word)
{
    for (const EOperatorRole role : {EOperatorRole::Viewer, EOperatorRole::Operator})
    {
        if (word == GetText(role))
        {
            return role;
        }
    }
    return std::nullopt;
}

std::string_view GetText(EOperatorRole role)
{
    return role == EOperatorRole::Viewer ? "viewer" : "operator";
}

bool IsOperatorName(std::string_view name)
{
    return !name.empty() && name.size() <= LONGEST_NAME && std::ranges::all_of(name, IsNameCharacter);
}

OperatorToken::Hash HashToken(std::string_view token)
{
    static_assert(OperatorToken::HASH_BYTES == SHA256_DIGEST_LENGTH);
    OperatorToken::Hash hash{};
    static_cast<void>(EVP_Digest(token.data(), token.size(), hash.data(), nullptr, EVP_sha256(), nullptr));
    return hash;
}

std::string MakeTokenText(const std::array<std::uint8_t, OperatorToken::HASH_BYTES>& random)
{
    // Four characters for three bytes, and a zero.
    std::array<unsigned char, 4 * ((OperatorToken::HASH_BYTES + 2) / 3) + 1> encoded{};
    const int length = EVP_EncodeBlock(encoded.data(), random.data(), static_cast<int>(random.size()));
    std::string text(encoded.begin(), encoded.begin() + length);
    std::ranges::replace(text, '+', '-');
    std::ranges::replace(text, '/', '_');
    return text.substr(0, text.find('='));
}

std::string MakeTokenLine(const OperatorToken& token)
{
    return fmt::format("{} {} {:02x}", GetText(token.role), token.name, fmt::join(token.hash, ""));
}

Core::Result<std::vector<OperatorToken>> ParseTokens(std::string_view text)
{
    std::vector<OperatorToken> tokens;
    for (std::size_t number = 1; !text.empty(); ++number)
    {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        std::string_view rest = line;
        if (const std::string_view first = Apps::TakeWord(rest); first.empty() || first.starts_with('#'))
        {
            continue;
        }
        std::optional<OperatorToken> token = ReadTokenLineOrNull(line);
        if (!token.has_value())
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                {},
                "ROLE NAME SHA256 (acsd token ROLE NAME prints such a line; ROLE is viewer or operator)",
                fmt::format("line {} with something else", number));
        }
        if (std::ranges::find(tokens, token->hash, &OperatorToken::hash) != tokens.end())
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                {},
                "a token of its own in each line",
                fmt::format("line {} with the token of another line", number));
        }
        tokens.push_back(std::move(*token));
        if (tokens.size() > MOST_TOKENS)
        {
            return Core::Fail(Core::ECoreError::OutOfRange, {}, fmt::format("at most {} tokens", MOST_TOKENS), "more");
        }
    }
    return tokens;
}

} // namespace ACS::Acsd
