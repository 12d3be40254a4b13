#include "commands/ContextCommands.hpp"

#include "config/ContextStore.hpp"
#include "view/DisplayText.hpp"
#include <acs/core/Result.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

std::string DescribeProof(const Context& context)
{
    if (!context.token.empty())
    {
        return "token";
    }
    if (!context.tokenFile.empty())
    {
        return "token of " + context.tokenFile;
    }
    return context.certificate.empty() ? "-" : "certificate " + context.certificate;
}

/// The path from the root, because a later command runs in another folder.
std::string MakeAbsolute(const std::string& path)
{
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error);
    return error ? path : absolute.string();
}

void SetPathIfAny(std::string& target, const std::optional<std::string>& pathOrNull)
{
    if (pathOrNull.has_value())
    {
        target = MakeAbsolute(*pathOrNull);
    }
}

void WriteContext(Json::JsonWriter& writer, const std::string& name, const Context& context, bool bCurrent)
{
    const auto write = [&writer](std::string_view key, const std::string& value) {
        writer.Key(key);
        if (value.empty())
        {
            writer.WriteNull();
        }
        else
        {
            writer.WriteString(value);
        }
    };
    writer.BeginObject();
    write("name", name);
    writer.Key("current");
    writer.WriteBoolean(bCurrent);
    write("url", context.url);
    writer.Key("hasToken");
    writer.WriteBoolean(!context.token.empty());
    write("tokenFile", context.tokenFile);
    write("ca", context.ca);
    write("certificate", context.certificate);
    write("key", context.key);
    writer.EndObject();
}

std::string ReadTokenOfInput()
{
    std::string token;
    for (int letter = std::cin.get(); letter != std::char_traits<char>::eof() && letter != '\n';
         letter = std::cin.get())
    {
        token += static_cast<char>(letter);
        if (token.size() > LONGEST_TOKEN)
        {
            break; // too long already
        }
    }
    while (token.ends_with('\r'))
    {
        token.pop_back();
    }
    return token;
}

tl::unexpected<CommandError> FailForUnknown(const std::string& name, const Contexts& contexts)
{
    std::string existing;
    for (const auto& [other, context] : contexts.entries)
    {
        existing.append(existing.empty() ? "; there are: " : ", ").append(other);
    }
    return FailWith(
        EXIT_REFUSED,
        fmt::format(
            "there is no context {}{}",
            Core::QuoteForError(name),
            existing.empty() ? "; acsctl context set adds one" : existing));
}

} // namespace

std::string ShowContexts(const Contexts& contexts, bool bJSON, const Screen& screen)
{
    if (bJSON)
    {
        std::string out;
        Json::JsonWriter writer(out);
        writer.BeginObject();
        writer.Key("contexts");
        writer.BeginArray();
        for (const auto& [name, context] : contexts.entries)
        {
            WriteContext(writer, name, context, name == contexts.current);
        }
        writer.EndArray();
        writer.EndObject();
        return MakeDisplayableJSON(out) + "\n";
    }
    if (contexts.entries.empty())
    {
        return "No context is configured.\n";
    }
    constexpr std::size_t URL = 16;
    TextTable table({{"", 0, 1}, {"NAME", 1, 8}, {"URL", 2, URL}, {"IDENTIFICATION", 3}});
    for (const auto& [name, context] : contexts.entries)
    {
        table.AddRow({{name == contexts.current ? "*" : ""}, {name}, {context.url}, {DescribeProof(context)}});
    }
    return table.Print(screen);
}

tl::expected<void, std::string> SetContext(
    const AcsctlOptions& options,
    const std::string& tokenOfInput,
    Contexts& contexts)
{
    const std::string& name = options.arguments.id;
    if (!IsContextName(name))
    {
        return tl::make_unexpected(std::string("the name of a context has 1 to 64 letters, digits and . _ -"));
    }
    const ConnectionOptions& given = options.connection;
    const bool bTwoTokens = given.tokenFile.has_value() && options.arguments.bTokenFromInput;
    if (bTwoTokens)
    {
        return tl::make_unexpected(std::string("--token-file and --token-stdin exclude each other"));
    }
    if (options.arguments.bTokenFromInput && !IsToken(tokenOfInput))
    {
        return tl::make_unexpected(
            fmt::format("the first line of standard input is not a token of at most {} characters", LONGEST_TOKEN));
    }
    Context context = contexts.entries.contains(name) ? contexts.entries.at(name) : Context();
    if (given.url.has_value())
    {
        if (const auto url = ParseHttpURL(*given.url); !url.has_value())
        {
            return tl::make_unexpected(url.error());
        }
        context.url = *given.url;
    }
    if (options.arguments.bTokenFromInput)
    {
        context.token = tokenOfInput;
        context.tokenFile.clear();
    }
    if (given.tokenFile.has_value())
    {
        context.token.clear();
    }
    SetPathIfAny(context.tokenFile, given.tokenFile);
    SetPathIfAny(context.ca, given.ca);
    SetPathIfAny(context.certificate, given.certificate);
    SetPathIfAny(context.key, given.key);
    if (context.url.empty())
    {
        return tl::make_unexpected(std::string("a new context needs --url"));
    }
    contexts.entries.insert_or_assign(name, std::move(context));
    contexts.current = contexts.current.empty() ? name : contexts.current;
    return {};
}

Outcome<std::string> RunContextCommand(
    const AcsctlOptions& options,
    const Environment& environment,
    const Screen& screen)
{
    const ContextStore store(environment);
    if (store.GetPath().empty())
    {
        return FailWith(
            EXIT_BAD_INPUT,
            "no folder for the configuration file: set HOME or XDG_CONFIG_HOME to an absolute path");
    }
    tl::expected<Contexts, std::string> contexts = store.Load();
    if (!contexts.has_value())
    {
        return FailWith(EXIT_BAD_INPUT, contexts.error());
    }
    const std::string& name = options.arguments.id;
    if (options.command == ECommand::ContextList)
    {
        return ShowContexts(*contexts, options.bJSON, screen);
    }
    std::string done;
    if (options.command == ECommand::ContextSet)
    {
        const std::string token = options.arguments.bTokenFromInput ? ReadTokenOfInput() : std::string();
        if (const auto set = SetContext(options, token, *contexts); !set.has_value())
        {
            return FailWith(EXIT_BAD_INPUT, set.error());
        }
        done = fmt::format("Context {} is set in {}.\n", name, store.GetPath());
    }
    else if (!contexts->entries.contains(name))
    {
        return FailForUnknown(name, *contexts);
    }
    else if (options.command == ECommand::ContextUse)
    {
        contexts->current = name;
        done = fmt::format("Context {} is the current one.\n", name);
    }
    else
    {
        contexts->entries.erase(name);
        contexts->current = contexts->current == name ? std::string() : contexts->current;
        done = fmt::format("Context {} is removed.\n", name);
    }
    if (const auto saved = store.Save(*contexts); !saved.has_value())
    {
        return FailWith(EXIT_LOCAL_FAILURE, saved.error());
    }
    return done;
}

} // namespace ACS::Acsctl
