#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/execution/outstanding_work.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/prefer.hpp>
#include <boost/system/error_code.hpp>

#include <charconv>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace ACS::Net
{

/// Finds the addresses of one host at a time. Asio's own resolver has one thread for all questions of an io_context, and its
/// destructor waits for it: a name server that does not answer would delay every other connection, and the end of the program.
/// Here a numeric address needs no thread, and the thread of a name may outlive this object and the program. An answer that
/// comes after Cancel is that of the next question for the same host. Used on the thread of the executor.
class HostLookup final
{
public:
    using Addresses = boost::asio::ip::tcp::resolver::results_type;
    using Handler = std::function<void(const boost::system::error_code& error, const Addresses& found)>;

private:
    using ErrorCode = boost::system::error_code;

    struct Answer
    {
        ErrorCode error;
        Addresses found;
    };

    enum class EProgress : std::uint8_t
    {
        Asked,
        Answered,
        Used
    };

    /// Used by both threads. The mutex protects what follows it.
    struct Question
    {
        const std::string host;
        const std::string port;
        std::mutex mutex;
        EProgress progress = EProgress::Asked;
        Answer answer;
        std::function<void(const Answer& answer)> onAnswer; ///< Empty: nothing waits for the answer.

        Question(std::string questionHost, std::string questionPort)
            : host(std::move(questionHost)),
              port(std::move(questionPort))
        {
        }
    };

    boost::asio::any_io_executor _executor;
    std::shared_ptr<Question> _questionOrNull;

public:
    explicit HostLookup(boost::asio::any_io_executor executor)
        : _executor(std::move(executor))
    {
    }

    HostLookup(const HostLookup&) = delete;
    HostLookup& operator=(const HostLookup&) = delete;

    /// The handler of a question without an answer is not called.
    ~HostLookup()
    {
        static_cast<void>(StopWaitingOrNull());
    }

    /// Calls the handler later, once. Cancels the question before.
    void ResolveAsync(const std::string& host, const std::string& port, Handler handler)
    {
        Cancel();
        if (std::optional<Answer> answer = ReadNumericOrNull(host, port))
        {
            Post(std::move(handler), std::move(*answer));
            return;
        }
        if (!IsFor(host, port))
        {
            _questionOrNull = std::make_shared<Question>(host, port);
            const ErrorCode error = StartThread(_questionOrNull);
            if (error.failed())
            {
                _questionOrNull = nullptr;
                Post(std::move(handler), {error, {}});
                return;
            }
        }
        const std::lock_guard lock(_questionOrNull->mutex);
        if (_questionOrNull->progress == EProgress::Answered)
        {
            _questionOrNull->progress = EProgress::Used;
            Post(std::move(handler), std::move(_questionOrNull->answer));
            return;
        }
        // The executor has work until then.
        _questionOrNull->onAnswer =
            [executor = boost::asio::prefer(_executor, boost::asio::execution::outstanding_work_t::tracked),
             handler = std::move(handler)](const Answer& answer) {
                boost::asio::post(executor, [handler, answer] { handler(answer.error, answer.found); });
            };
    }

    /// A handler that waits is called with operation_aborted.
    void Cancel()
    {
        if (const std::function<void(const Answer&)> onAnswer = StopWaitingOrNull())
        {
            onAnswer({boost::asio::error::operation_aborted, {}});
        }
    }

private:
    /// Whether the present question has this host, and its answer is not used yet.
    [[nodiscard]] bool IsFor(const std::string& host, const std::string& port)
    {
        if (_questionOrNull == nullptr || _questionOrNull->host != host || _questionOrNull->port != port)
        {
            return false;
        }
        const std::lock_guard lock(_questionOrNull->mutex);
        return _questionOrNull->progress != EProgress::Used;
    }

    /// The function that waited.
    [[nodiscard]] std::function<void(const Answer&)> StopWaitingOrNull()
    {
        if (_questionOrNull == nullptr)
        {
            return nullptr;
        }
        const std::lock_guard lock(_questionOrNull->mutex);
        return std::exchange(_questionOrNull->onAnswer, nullptr);
    }

    void Post(Handler handler, Answer answer)
    {
        boost::asio::post(_executor, [handler = std::move(handler), answer = std::move(answer)] {
            handler(answer.error, answer.found);
        });
    }

    [[nodiscard]] static std::optional<Answer> ReadNumericOrNull(const std::string& host, const std::string& port)
    {
        ErrorCode error;
        const boost::asio::ip::address address = boost::asio::ip::make_address(host, error);
        std::uint16_t number = 0;
        const char* const end = port.data() + port.size();
        const auto [rest, fault] = std::from_chars(port.data(), end, number);
        if (error.failed() || fault != std::errc() || rest != end)
        {
            return std::nullopt;
        }
        return Answer{{}, Addresses::create(boost::asio::ip::tcp::endpoint(address, number), host, port)};
    }

    [[nodiscard]] static ErrorCode StartThread(const std::shared_ptr<Question>& question)
    {
        try
        {
            std::thread([question] { Ask(*question); }).detach();
            return {};
        }
        catch (const std::system_error&) // there are too many threads
        {
            return boost::asio::error::no_memory;
        }
    }

    static void Ask(Question& question)
    {
        boost::asio::io_context context;
        Answer answer;
        answer.found = boost::asio::ip::tcp::resolver(context).resolve(question.host, question.port, answer.error);
        const std::lock_guard lock(question.mutex);
        if (const std::function<void(const Answer&)> onAnswer = std::exchange(question.onAnswer, nullptr))
        {
            question.progress = EProgress::Used;
            onAnswer(answer);
            return;
        }
        question.progress = EProgress::Answered;
        question.answer = std::move(answer);
    }
};

} // namespace ACS::Net
