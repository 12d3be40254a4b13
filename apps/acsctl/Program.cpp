#include "Program.hpp"

#include "commands/ActionCommand.hpp"
#include "commands/Answers.hpp"
#include "commands/BundleCommand.hpp"
#include "commands/CommandError.hpp"
#include "commands/ContextCommands.hpp"
#include "commands/EventsCommand.hpp"
#include "commands/Requests.hpp"
#include "commands/Session.hpp"
#include "commands/WhyCommand.hpp"
#include "common/config/CommandLine.hpp"
#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "completion/CompletionScripts.hpp"
#include "terminal/Terminal.hpp"
#include "trace/TraceCommand.hpp"
#include "view/DisplayText.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Uuid.hpp>

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

std::optional<std::string> GetVariableOrNull(const char* name)
{
    const char* const valueOrNull = std::getenv(name); // NOLINT(concurrency-mt-unsafe): there is one thread
    return valueOrNull == nullptr || *valueOrNull == '\0' ? std::nullopt : std::optional<std::string>(valueOrNull);
}

/// Nullopt if COLUMNS is not a number above 0.
std::optional<std::size_t> ReadColumnsOrNull()
{
    const std::optional<std::size_t> columns =
        Core::ParseNumberOrNull<std::size_t>(GetVariableOrNull("COLUMNS").value_or(""));
    return columns != 0 ? columns : std::nullopt;
}

int Report(const CommandError& error)
{
    Apps::PrintError(PROGRAM_NAME, MakeDisplayable(error.text));
    return error.exitCode;
}

int Finish(const Terminal& terminal, int exitCode)
{
    return terminal.IsFailed() ? Report({EXIT_LOCAL_FAILURE, "the output could not be written"}) : exitCode;
}

int PrintShown(const Outcome<Shown>& shown, Terminal& terminal)
{
    if (!shown.has_value())
    {
        return Report(shown.error());
    }
    terminal.Write(shown->text);
    return Finish(terminal, shown->exitCode);
}

int Print(const Outcome<std::string>& text, Terminal& terminal)
{
    return PrintShown(text.map([](const std::string& shown) { return Shown{shown}; }), terminal);
}

Outcome<Shown> Read(Session& session, const AcsctlOptions& options, const Terminal& terminal)
{
    const ViewContext context{terminal.GetScreen(), Apps::SystemClock().GetNow().wall};
    if (options.command == ECommand::Why)
    {
        return RunWhy(session.GetAPI(), options, context);
    }
    const Outcome<std::string> body = Get(session.GetAPI(), MakeReadTarget(options));
    return body.has_value() ? ShowAnswer(options, *body, context) : tl::make_unexpected(body.error());
}

/// Repeats a command that reads until the operator interrupts it. The first failure ends it; later ones are shown.
int Watch(Session& session, const AcsctlOptions& options, Terminal& terminal)
{
    EventLoop& loop = session.GetLoop();
    loop.CatchInterrupts();
    bool bFirst = true;
    while (!loop.IsInterrupted() && !terminal.IsFailed())
    {
        const Outcome<Shown> shown = Read(session, options, terminal);
        if (loop.IsInterrupted())
        {
            break;
        }
        if (!shown.has_value() && bFirst)
        {
            return Report(shown.error());
        }
        if (!shown.has_value() && options.bJSON)
        {
            static_cast<void>(Report(shown.error()));
        }
        else if (options.bJSON)
        {
            terminal.Write(shown->text);
        }
        else
        {
            terminal.Redraw(shown.has_value() ? shown->text : MakeDisplayable(shown.error().text) + "\n");
        }
        bFirst = false;
        loop.Pause(*options.watch);
    }
    return Finish(terminal, EXIT_DONE);
}

int RunRead(Session& session, const AcsctlOptions& options, Terminal& terminal)
{
    return options.watch.has_value() ? Watch(session, options, terminal)
                                     : PrintShown(Read(session, options, terminal), terminal);
}

/// Nullopt: the command may be sent.
std::optional<int> AskOrNull(const AcsctlOptions& options)
{
    const std::optional<std::string> question = MakeQuestionOrNull(options);
    if (!question.has_value() || options.bYes)
    {
        return std::nullopt;
    }
    if (!Terminal::CanAsk())
    {
        return Report({EXIT_BAD_INPUT, *question + " Without a terminal this command needs --yes"});
    }
    return Terminal::IsConfirmed(*question) ? std::nullopt
                                            : std::optional(Report({EXIT_REFUSED, "not confirmed; nothing was sent"}));
}

int RunChange(Session& session, ApiRequest request, const AcsctlOptions& options, Terminal& terminal)
{
    if (const std::optional<int> exitCode = AskOrNull(options); exitCode.has_value())
    {
        return *exitCode;
    }
    Apps::SystemRandom random;
    request.idempotencyKey = Core::MakeUUID(random);
    const tl::expected<ApiAnswer, ApiFailure> answer = session.GetAPI().Send(request);
    if (!answer.has_value())
    {
        return Report(MakeError(answer.error(), true));
    }
    return PrintShown(ShowChange(options, *answer), terminal);
}

int RunActionCommand(Session& session, const AcsctlOptions& options, Terminal& terminal)
{
    if (const std::optional<int> exitCode = AskOrNull(options); exitCode.has_value())
    {
        return *exitCode;
    }
    Apps::SystemRandom random;
    return PrintShown(RunAction(session, options, Core::MakeUUID(random)), terminal);
}

bool IsContextCommand(ECommand command)
{
    return command == ECommand::ContextList || command == ECommand::ContextUse || command == ECommand::ContextSet
        || command == ECommand::ContextRemove;
}

int RunEvents(Session& session, const AcsctlOptions& options, Terminal& terminal)
{
    const Outcome<void> done = EventsCommand(session, options, terminal).Run();
    return done.has_value() ? Finish(terminal, EXIT_DONE) : Report(done.error());
}

/// Of a command that needs acsd.
int RunRemote(const AcsctlOptions& options, const Environment& environment, Terminal& terminal)
{
    std::optional<ApiRequest> change = MakeChangeOrNull(options);
    const bool bReads =
        !change.has_value() && options.command != ECommand::Bundle && options.command != ECommand::Action;
    if (options.watch.has_value() && !bReads)
    {
        return Report({EXIT_BAD_INPUT, "--watch is for commands that read"});
    }
    Session session;
    if (const Outcome<void> opened = session.Open(options, environment); !opened.has_value())
    {
        return Report(opened.error());
    }
    if (change.has_value())
    {
        return RunChange(session, std::move(*change), options, terminal);
    }
    if (options.command == ECommand::Action)
    {
        return RunActionCommand(session, options, terminal);
    }
    if (options.command == ECommand::Bundle)
    {
        return PrintShown(RunBundle(session, options), terminal);
    }
    return options.command == ECommand::Events ? RunEvents(session, options, terminal)
                                               : RunRead(session, options, terminal);
}

} // namespace

Environment ReadEnvironment()
{
    Environment environment;
    environment.url = GetVariableOrNull("ACSCTL_URL");
    environment.token = GetVariableOrNull("ACSCTL_TOKEN");
    environment.context = GetVariableOrNull("ACSCTL_CONTEXT");
    environment.configHome = GetVariableOrNull("XDG_CONFIG_HOME");
    environment.home = GetVariableOrNull("HOME");
    environment.columns = ReadColumnsOrNull();
    environment.bNoColor = GetVariableOrNull("NO_COLOR").has_value();
    environment.bDumbTerminal = GetVariableOrNull("TERM").value_or("dumb") == "dumb";
    return environment;
}

int Run(const AcsctlOptions& options, const Environment& environment)
{
    Terminal terminal(!options.bPlain && !environment.bNoColor && !environment.bDumbTerminal, environment.columns);
    if (options.command == ECommand::Completion)
    {
        return Print(std::string(options.arguments.word == "zsh" ? ZSH_SCRIPT : BASH_SCRIPT), terminal);
    }
    if (options.command == ECommand::Trace && !options.arguments.files.empty())
    {
        return Print(RunTraceFiles(options, {terminal.GetScreen(), Apps::SystemClock().GetNow().wall}), terminal);
    }
    return IsContextCommand(options.command)
        ? Print(RunContextCommand(options, environment, terminal.GetScreen()), terminal)
        : RunRemote(options, environment, terminal);
}

} // namespace ACS::Acsctl
