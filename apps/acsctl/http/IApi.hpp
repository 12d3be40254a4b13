#pragma once

#include "http/ApiFailure.hpp"
#include "http/ApiRequest.hpp"

#include <tl/expected.hpp>

#include <functional>
#include <string_view>

namespace ACS::Acsctl
{

/// The connection to acsd.
class IApi
{
public:
    IApi() = default;
    IApi(const IApi&) = delete;
    IApi& operator=(const IApi&) = delete;
    virtual ~IApi() = default;

    /// Sends a request and reads the whole answer. A POST whose connection is lost is sent once more with its key.
    [[nodiscard]] virtual tl::expected<ApiAnswer, ApiFailure> Send(const ApiRequest& request) = 0;

    /// Sends a GET and passes the body as it arrives, while the function returns true. An answer with another status than 200
    /// is returned as a whole. The stream is lost when nothing arrives for 45 s; the failure states whether it had begun.
    [[nodiscard]] virtual tl::expected<ApiAnswer, ApiFailure> Stream(
        const ApiRequest& request,
        const std::function<bool(std::string_view)>& tryHandle) = 0;
};

} // namespace ACS::Acsctl
