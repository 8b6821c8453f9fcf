/// Keeps an answer of the server up with the sliders: one request at a time, always for the latest question, so that
/// a fast slider skips models rather than piling them up.
export class Following<Question, Answer> {
    private wanted: Question | undefined;
    private isBusy = false;
    private since: number | undefined;  // the first event that no answer takes into account yet
    private answered: number | undefined;

    constructor(
        private readonly ask: (question: Question) => Promise<Answer>,
        private readonly show: (answer: Answer, question: Question) => void,
        private readonly fail: (error: unknown) => void,
    ) {}

    /// What to ask, and when a slider changed it.
    want(question: Question, since?: number): void {
        this.wanted = question;
        this.since ??= since;
        if (!this.isBusy) void this.work();
    }

    /// The answer has been drawn: measures "slider-to-curve" from the event to here.
    drawn(): void {
        if (this.answered === undefined) return;
        performance.measure("slider-to-curve", {start: this.answered, end: performance.now()});
        this.answered = undefined;
    }

    private async work(): Promise<void> {
        this.isBusy = true;
        while (this.wanted) {
            const question = this.wanted;
            const since = this.since;
            this.wanted = this.since = undefined;
            try {
                const answer = await this.ask(question);
                this.answered = since;
                this.show(answer, question);
            } catch (error) {
                this.fail(error);
            }
        }
        this.isBusy = false;
    }
}
