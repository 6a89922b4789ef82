// What a text says, and what an error says.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <initializer_list>
#include <string>
#include <string_view>

namespace rotorub::test {

// Whether all these parts stand in the text. EXPECT_TRUE shows the part that is missing, and the
// beginning of the text.
inline testing::AssertionResult contains(const std::string& text,
                                         std::initializer_list<std::string_view> parts) {
  const std::string shown = text.substr(0, 4000);
  for (const std::string_view part : parts) {
    if (text.find(part) == std::string::npos)
      return testing::AssertionFailure() << "`" << part << "` is missing in:\n" << shown;
  }
  return testing::AssertionSuccess() << shown;
}
inline testing::AssertionResult contains(const std::string& text, std::string_view part) {
  return contains(text, {part});
}

// What the error says that the action throws; empty: it throws none. Another error goes on.
template <class Error = std::exception, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace rotorub::test
