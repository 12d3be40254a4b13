#include "operator/OperatorToken.hpp"

#include "Catch.hpp"

#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::EOperatorRole;

namespace
{

constexpr const char* HASH_OF_ABC =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"; // FIPS 180-2, B.1

std::string GetParseError(const std::string& text)
{
    const auto tokens = Acsd::ParseTokens(text);
    return tokens.has_value() ? "none" : tokens.error().found;
}

} // namespace

TEST_CASE("A line of the file of tokens has the SHA-256 of the token, and is read as it was written")
{
    const Acsd::OperatorToken token{EOperatorRole::Operator, "kim@plant", Acsd::HashToken("abc")};
    CHECK(Acsd::MakeTokenLine(token) == std::string("operator kim@plant ") + HASH_OF_ABC);
    const Acsd::OperatorToken viewer{EOperatorRole::Viewer, "grafana", Acsd::HashToken("def")};
    const auto tokens = Acsd::ParseTokens(
        "# who\n\n" + Acsd::MakeTokenLine(token) + "\r\n  # next\n\t" + Acsd::MakeTokenLine(viewer) + "  ");
    REQUIRE(tokens.has_value());
    CHECK(*tokens == std::vector{token, viewer});
    CHECK(Acsd::ParseTokens("")->empty());
}

TEST_CASE("A token is text that fits in a header, and differs with each of its bytes")
{
    std::array<std::uint8_t, Acsd::OperatorToken::HASH_BYTES> random{};
    random.fill(0xFB);
    const std::string token = Acsd::MakeTokenText(random);
    CHECK(token.size() == 43);
    CHECK(token.starts_with("-_v7"));
    CHECK(token.find_first_of("+/=") == std::string::npos);
    random.back() = 0xFA;
    CHECK(Acsd::MakeTokenText(random) != token);
}

TEST_CASE("An invalid line of the file of tokens is refused with its number")
{
    const std::string hash = HASH_OF_ABC;
    for (const std::string& line :
         {std::string("kim"),
          "root kim " + hash,
          "operator " + hash,
          "operator kim " + hash.substr(1),
          "operator kim " + hash + "0",
          "operator kim g" + hash.substr(1),
          "operator kim " + hash + " x",
          "operator k\"m " + hash,
          "operator " + std::string(65, 'k') + " " + hash})
    {
        INFO(line);
        CHECK(GetParseError("viewer a " + std::string(64, '0') + "\n" + line) == "line 2 with something else");
    }
    CHECK(GetParseError("viewer a " + hash + "\noperator b " + hash) == "line 2 with the token of another line");
    std::string many;
    for (int i = 0; i < 1'001; ++i)
    {
        many += Acsd::MakeTokenLine({EOperatorRole::Viewer, "a", Acsd::HashToken(std::to_string(i))}) + "\n";
    }
    CHECK(GetParseError(many) == "more");
}
