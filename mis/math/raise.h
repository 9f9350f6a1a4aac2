#pragma once

#include <cstdlib>
#include <string>

namespace mis {

/// throw Error(what). In a host that is built without exceptions it ends the program: what the
/// docstring says is thrown is then a precondition.
template <class Error> [[noreturn]] void raise(const std::string& what)
{
#if defined(__cpp_exceptions)
    throw Error(what);
#else
    static_cast<void>(what);
    std::abort();
#endif
}

/// body(); did it end without throwing Error? In a host that is built without exceptions it did.
template <class Error, class Body> bool ends_without(const Body& body)
{
#if defined(__cpp_exceptions)
    try {
        body();
    } catch (const Error&) {
        return false;
    }
#else
    body();
#endif
    return true;
}

}  // namespace mis
