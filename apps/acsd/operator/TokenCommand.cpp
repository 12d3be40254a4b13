#include "operator/TokenCommand.hpp"

#include "common/config/CommandLine.hpp"
#include "operator/OperatorToken.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <openssl/rand.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>

namespace ACS::Acsd
{

namespace
{

constexpr const char* COMMAND = "acsd token";

std::string CheckName(const std::string& name)
{
    return IsOperatorName(name) ? std::string() : "expected a name of 1 to 64 letters, digits and . _ - @";
}

} // namespace

int RunTokenCommand(int argc, const char* const* argv)
{
    CLI::App app{
        "Makes a token for the operator interface (operator.tokens_file). The line for the file is printed on standard "
        "output, the token itself on standard error. The file has only its SHA-256: the token cannot be shown again.",
        COMMAND};
    std::string role;
    std::string name;
    app.add_option("role", role, "viewer: may read; operator: may also send commands")
        ->required()
        ->type_name("ROLE")
        ->check(CLI::IsMember({"viewer", "operator"}));
    app.add_option("name", name, "name of the person or program, for the audit log")
        ->required()
        ->type_name("NAME")
        ->check(CLI::Validator(CheckName, ""));
    app.footer("Example: acsd token operator kim >> tokens");
    const std::optional<int> exitCodeOrNull = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCodeOrNull.has_value())
    {
        return *exitCodeOrNull;
    }
    std::array<std::uint8_t, OperatorToken::HASH_BYTES> random{};
    if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    {
        Apps::PrintError(COMMAND, "the system has no random numbers");
        return 1;
    }
    const std::string token = MakeTokenText(random);
    const std::string line = MakeTokenLine({*ReadRoleOrNull(role), name, HashToken(token)}) + '\n';
    // The token is shown only if its line is in the file: without it the token is not valid.
    if (std::fputs(line.c_str(), stdout) == EOF || std::fflush(stdout) == EOF)
    {
        const std::string reason = std::generic_category().message(errno);
        Apps::PrintError(
            COMMAND,
            fmt::format("the line cannot be written to standard output: {}. No token is made", reason));
        return 1;
    }
    fmt::print(stderr, "token of {}, shown only now: {}\n", name, token);
    return 0;
}

} // namespace ACS::Acsd
