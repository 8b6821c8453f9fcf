import {render} from "preact";
import {api} from "./api";
import {App} from "./app";

const root = document.getElementById("app")!;

api.vocabulary().then(
    (vocabulary) => render(<App vocabulary={vocabulary} />, root),
    (error: Error) => render(<main class="alone"><h1>skinfit explore</h1><p class="banner problem" role="alert">{error.message}</p></main>, root));
